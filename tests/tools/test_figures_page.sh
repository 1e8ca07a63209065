#!/usr/bin/env bash
# The page of strata figures --html in a browser: it loads without an error, its sliders follow keyboard, mouse and touch,
# every picture has an alternative text. Skipped, exit code 77, where there is no Chromium.
# With PAGE_SCREENSHOTS=FOLDER it leaves pictures of the page there.
# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"
# shellcheck source=tests/tools/page_driver.sh
. "${BASH_SOURCE[0]%/*}/page_driver.sh"

if [[ ! $chromium ]]; then
    echo 'skipped: Chromium is not installed'
    exit 77
fi

page=$scratch/page

no_errors() { # where
    local wrong
    wrong=$(grep -E '"Runtime.exceptionThrown"|"level":"error"|"type":"error"|Network.loadingFailed' "$scratch/events")
    expect "$1: no error on the console, nothing fails to load" "$wrong" ''
    wrong=$(grep -o '"request":{[^}]*"url":"[^"]*"' "$scratch/events" | grep -v -E '"url":"(file://'"$page"'|data:|about:)')
    expect "$1: nothing is loaded from elsewhere" "$wrong" ''
}

check_alternative_texts() {
    evaluate "[...document.images].filter(i => i.alt.trim().length < 10).length"
    expect 'every picture has an alternative text' "$value" 0
    evaluate "document.images.length"
    expect_match 'there are pictures' "$value" '[1-9]*'
    evaluate "Promise.all([...document.images].map(i => { i.loading = 'eager'; return i.decode().then(() => 0, () => 1); })).then(a => a.reduce((x, y) => x + y, 0))"
    expect 'every picture can be shown' "$value" 0
    evaluate "[...document.querySelectorAll('input')].filter(i => !i.getAttribute('aria-label')).length"
    expect 'every slider has a name' "$value" 0
}

# Sets x, y to a place in the first comparison's pictures, a fraction of the width from their left.
place() { # fraction
    evaluate "(() => { const s = document.querySelector('.stage'); s.scrollIntoView({behavior: 'instant', block: 'center'}); const b = s.getBoundingClientRect(); return Math.round(b.left + $1 * b.width) + ' ' + Math.round(b.top + b.height / 2); })()"
    read -r x y <<<"$value"
}

slider_is() { # sentence least most
    evaluate "document.querySelector('.comparison input').value + ' ' + parseFloat(document.querySelector('.stage').style.getPropertyValue('--split'))"
    local input split
    read -r input split <<<"$value"
    expect "$1" "$((input >= $2 && input <= $3)) $split" "1 $input"
}

check_sliders() {
    slider_is 'a slider starts in the middle' 50 50
    evaluate "(document.querySelector('.comparison input').focus(), document.activeElement.type)"
    expect 'a slider takes the focus' "$value" range
    key ArrowRight 39
    key ArrowRight 39
    slider_is 'the arrow moves it right' 52 52
    key Home 36
    slider_is 'Home moves it to the left end' 0 0
    key ArrowLeft 37
    slider_is 'it stays at its end' 0 0
    key End 35
    slider_is 'End moves it to the right end' 100 100

    local x y
    place 0.25
    mouse mousePressed "$x" "$y"
    slider_is 'a press of the mouse moves it there' 24 26
    place 0.8
    mouse mouseMoved "$x" "$y"
    slider_is 'dragging moves it along' 79 81
    mouse mouseReleased "$x" "$y"
    place 0.3
    mouse mouseMoved "$x" "$y"
    slider_is 'released, it stays' 79 81
    evaluate "getComputedStyle(document.querySelector('.stage img.right')).clipPath.includes('80')"
    expect 'the right picture is clipped there' "$value" true
}

check_touch() {
    local x y
    call Emulation.setTouchEmulationEnabled '{"enabled":true}'
    place 0.6
    touch touchStart "{\"x\":$x,\"y\":$y}"
    slider_is 'a touch moves it there' 59 61
    place 0.1
    touch touchMove "{\"x\":$x,\"y\":$y}"
    touch touchEnd ''
    slider_is 'a finger that slides moves it along' 9 11
}

check_width() { # where
    evaluate "document.documentElement.scrollWidth <= window.innerWidth"
    expect "$1: nothing is wider than the window" "$value" true
}

look() { # name
    [[ ! ${PAGE_SCREENSHOTS-} ]] || screenshot "$PAGE_SCREENSHOTS/$1.png" true
}

colours() { # scheme
    call Emulation.setEmulatedMedia "{\"features\":[{\"name\":\"prefers-color-scheme\",\"value\":\"$1\"}]}"
    evaluate "getComputedStyle(document.body).backgroundColor"
}

window_of() { # width height mobile
    call Emulation.setDeviceMetricsOverride "{\"width\":$1,\"height\":$2,\"deviceScaleFactor\":1,\"mobile\":$3}"
}

check_page() {
    run figures --only 1,4 --size small -o "$page" --html --no-films --quiet
    expect 'the page is made' "$status: $output" '0: '
    if open_browser 1280 800; then
        visit "file://$page/index.html"
        check_alternative_texts
        check_sliders
        window_of 1280 800 false
        check_width laptop
        colours light
        light=$value
        look laptop-light
        colours dark
        expect_match 'the dark page is another' "$light, $value" 'rgb(253, 253, 252), rgb(21, 22, 26)'
        look laptop-dark
        window_of 390 844 true
        check_width phone
        check_touch
        look phone-dark
        colours light
        look phone-light
        no_errors 'the page'
        close_browser
    else
        expect 'the browser starts' "$(tail -5 "$scratch/browser.log")" started
    fi
}

run_groups check_page
