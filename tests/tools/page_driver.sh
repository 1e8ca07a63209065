# shellcheck shell=bash
# A page in headless Chromium, driven through its DevTools protocol over a pipe: messages are JSON ended by NUL. To be
# sourced in a test that has a folder $scratch.

: "${scratch:?}"
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome)

# Starts the browser, to be ended with this shell, with a window of this size in CSS pixels. Leaves `call` ready.
open_browser() { # width height options...
    local width=$1 height=$2
    shift 2
    mkfifo "$scratch/to" "$scratch/from"
    "$chromium" --headless --no-sandbox --disable-gpu --hide-scrollbars --force-device-scale-factor=1 --disable-extensions \
        --disable-background-networking --no-first-run "--user-data-dir=$scratch/profile" "--window-size=$width,$height" \
        --remote-debugging-pipe "$@" about:blank 3<"$scratch/to" 4>"$scratch/from" >/dev/null 2>"$scratch/browser.log" &
    browser=$!
    trap 'kill "$browser" 2>/dev/null; wait "$browser" 2>/dev/null' EXIT
    exec {to}>"$scratch/to" {from}<"$scratch/from"
    rm "$scratch/to" "$scratch/from"
    last_id=0 session=''
    : >"$scratch/events"
    call Target.createTarget '{"url":"about:blank"}' || return
    [[ $answer =~ \"targetId\":\"([^\"]*)\" ]] || return
    call Target.attachToTarget "{\"targetId\":\"${BASH_REMATCH[1]}\",\"flatten\":true}" || return
    [[ $answer =~ \"sessionId\":\"([^\"]*)\" ]] || return
    session=${BASH_REMATCH[1]}
    local domain
    for domain in Runtime Log Page Network; do call "$domain.enable" '{}' || return; done
}

close_browser() {
    session='' call Browser.close '{}'
    exec {to}>&- {from}<&-
    wait "$browser"
}

# Sets answer to what the browser returns; events that come before it go to $scratch/events.
call() { # method parameters
    ((++last_id))
    printf '{"id":%d,"method":"%s","params":%s%s}\0' "$last_id" "$1" "$2" "${session:+,\"sessionId\":\"$session\"}" >&"$to"
    while IFS= read -r -d '' -t 60 answer <&"$from"; do
        [[ $answer == "{\"id\":$last_id,"* ]] && return
        printf '%s\n' "$answer" >>"$scratch/events"
    done
    echo "no answer to $1" >&2
    return 1
}

# Sets value to what a JavaScript expression gives, as a string. The expression holds no double quotes.
evaluate() { # expression
    call Runtime.evaluate "{\"expression\":\"Promise.resolve($1).then(String)\",\"awaitPromise\":true,\"returnByValue\":true}"
    value=''
    if [[ $answer =~ \"type\":\"string\",\"value\":\"([^\"]*)\" ]]; then value=${BASH_REMATCH[1]}; else echo "$answer" >&2; fi
}

# Opens a page and waits until it and its pictures are there.
visit() { # URL
    local i
    call Page.navigate "{\"url\":\"$1\"}"
    for ((i = 0; i < 100; ++i)); do
        evaluate "document.readyState === 'complete' && location.href !== 'about:blank'"
        [[ $value == true ]] && break
        sleep 0.1
    done
}

mouse() { # type x y
    call Input.dispatchMouseEvent "{\"type\":\"$1\",\"x\":$2,\"y\":$3,\"button\":\"left\",\"buttons\":1,\"clickCount\":1}"
}

touch() { # type points
    call Input.dispatchTouchEvent "{\"type\":\"$1\",\"touchPoints\":[$2]}"
}

key() { # name code
    call Input.dispatchKeyEvent "{\"type\":\"keyDown\",\"key\":\"$1\",\"code\":\"$1\",\"windowsVirtualKeyCode\":$2}"
    call Input.dispatchKeyEvent "{\"type\":\"keyUp\",\"key\":\"$1\",\"code\":\"$1\",\"windowsVirtualKeyCode\":$2}"
}

# A PNG of the window, or of the whole page.
screenshot() { # file whole
    call Page.captureScreenshot "{\"captureBeyondViewport\":${2:-false}}"
    [[ $answer =~ \"data\":\"([^\"]*)\" ]] && base64 -d <<<"${BASH_REMATCH[1]}" >"$1"
}
