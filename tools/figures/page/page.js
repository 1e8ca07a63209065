"use strict";

// The page is built of the records that stand in it: one a figure and one a film, as they lie beside it.
const records = JSON.parse(document.getElementById("records").textContent);

const element = (tag, attributes, ...content) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...content);
  return made;
};

const add = (anchor, name, title, ...content) => {
  document.getElementById("contents").append(element("li", {}, element("a", { href: "#" + anchor }, name)));
  document.getElementById("figures").append(element("section", { id: anchor }, element("h2", {}, title), ...content));
};

const command = (record) => element("pre", {}, element("code", {}, record.command));
const captioned = (record, shown) => element("figure", {}, shown, element("figcaption", {}, record.caption));
const folded = (summary, content) => element("details", {}, element("summary", {}, summary), content);

const comparison = (record, { left, right, left_label, right_label }) => {
  const picture = (file, style) => {
    const { alt } = record.shown.find((shown) => shown.file === file);
    return element("img", { loading: "lazy", alt, src: file, ...style });
  };
  const labels = element("p", { class: "labels" }, element("span", {}, left_label), element("span", {}, right_label));
  const stage = element("div", { class: "stage" }, picture(left, {}), picture(right, { class: "right" }));
  const name = `Divide between ${left_label}, left, and ${right_label}, right`;
  const slider = element("input", { type: "range", min: 0, max: 100, step: 1, value: 50, "aria-label": name });
  return element("div", { class: "comparison" }, labels, stage, slider);
};

// What has nothing in it is left out.
const list_of = (items, build) => (items.length > 0 ? [build(items)] : []);

for (const record of records.figures) {
  const anchor = "figure-" + record.figure;
  // Plots as vector graphics.
  const { file } = record.shown.find((shown) => shown.file.endsWith(".svg")) ?? record.shown[0];
  const whole = element("a", { class: "whole", href: file }, element("img", { src: file, alt: record.shown[0].alt }));
  const comparisons = (pairs) =>
    element("div", { class: "comparisons" }, ...pairs.map((pair) => comparison(record, pair)));
  const chosen = (choices) =>
    element("div", { class: "chosen" }, element("p", { class: "label" }, "Chosen here, not told by the paper:"),
      element("ul", {}, ...choices.map((choice) => element("li", {}, choice))));
  const { size, version, simd_target, parameters, parts } = record;
  const settings = JSON.stringify({ size, version, simd_target, parameters, parts }, null, 2);
  const files = [...[...record.shown, ...parts].map((one) => one.file), ...record.data, anchor + ".json"];
  const links = files.map((one) => element("li", {}, element("a", { href: one }, one)));
  add(anchor, `Figure ${record.figure}`, `Figure ${record.figure}. ${record.title}`, captioned(record, whole),
    ...list_of(record.comparisons, comparisons), ...list_of(record.chosen, chosen), command(record),
    folded("Parameters", element("pre", {}, settings)), folded("Files", element("ul", { class: "files" }, ...links)));
}

for (const record of records.films) {
  const type = (file) => "video/" + file.slice(file.lastIndexOf(".") + 1);
  const sources = record.files.map((file) => element("source", { src: file, type: type(file) }));
  const attributes = { controls: "", loop: "", playsinline: "", "aria-label": record.caption };
  const film = element("video", attributes, ...sources);
  film.muted = true;
  add(record.animation, record.title.split(".")[0], record.title, captioned(record, film), command(record));
}

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
