"use strict";

// A comparison shows its left picture up to the slider's place and its right one beyond. The range input below is moved
// by keyboard and by assistive technology; the pictures themselves by mouse, pen and touch.
for (const comparison of document.querySelectorAll(".comparison")) {
  const stage = comparison.querySelector(".stage");
  const slider = comparison.querySelector("input");
  const show = () => {
    stage.style.setProperty("--split", slider.value + "%");
    slider.setAttribute("aria-valuetext", slider.value + " % of the left picture");
  };
  const follow = (event) => {
    const box = stage.getBoundingClientRect();
    slider.value = (100 * (event.clientX - box.left)) / box.width;
    show();
  };
  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    follow(event);
  });
  stage.addEventListener("pointermove", (event) => {
    if (stage.hasPointerCapture(event.pointerId)) follow(event);
  });
  slider.addEventListener("input", show);
  comparison.classList.add("live");
  show();
}

// Films start by themselves only where motion is welcome. The attribute autoplay would wait for a film to be scrolled to,
// and would not ask.
if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
  for (const film of document.querySelectorAll("video")) film.play().catch(() => {});
}
