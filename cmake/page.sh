# Used by cmake/setup.sh: builds the operator panel's web page, if that is possible. Sourced, not run.
# shellcheck shell=bash

# Oldest usable version of Node.js: that of Debian 12.
page_node=18

# page_packages: installs the packages of hmi/package-lock.json into hmi/node_modules, unless they are there. npm takes
# packages from its cache if it has them, so that only new ones need the network.
page_packages() {
    local stamp=hmi/node_modules/.made-of want log
    want=$(sha256sum hmi/package-lock.json)
    [ "$(cat "$stamp" 2>/dev/null)" = "$want" ] && return 0
    say "fetching the packages of the operator panel's page"
    log=$(mktemp)
    if ! (cd hmi && npm ci --prefer-offline --no-audit --no-fund --fetch-retries 1) >"$log" 2>&1; then
        why_npm_failed "$log"
        return 1
    fi
    rm -f "$log"
    printf '%s' "$want" >"$stamp"
}

# why_npm_failed LOG: prints the reason for the failure of npm, with its remedy.
why_npm_failed() {
    local log=$1 unreached
    unreached=$(sed -nE 's/^npm (ERR!|error) (.* )?request to .* failed, reason: (.*)/\3/p' "$log" | head -n 1)
    if [ -n "$unreached" ]; then
        say "the packages of the operator panel's page could not be fetched from the network ($unreached);" \
            "the page was not built. Bring the network up (behind a proxy: set https_proxy), then run $0 again."
    elif ! no_room hmi; then
        tail -n 15 "$log" >&2
        say "npm could not put the packages of the operator panel's page into hmi/node_modules;" \
            "the page was not built. The whole log is $log: do what it says, then run $0 again."
    fi
}

# page_node_is_new: installs node and npm if they are missing; fails with a message unless node is new enough.
page_node_is_new() {
    local version
    if ! command -v node >/dev/null 2>&1 || ! command -v npm >/dev/null 2>&1; then
        need_packages nodejs npm && need_program node nodejs && need_program npm npm || return 1
    fi
    version=$(node --version)
    older "${version#v}" "$page_node" || return 0
    say "node is version ${version#v}; the operator panel's page needs $page_node or newer and was not built." \
        "Put a newer one first in PATH, or use Debian 12, which has it."
    return 1
}

# build_page FOLDER: builds the operator panel's web page into FOLDER/share/motionrack/page, where the program in
# FOLDER/bin looks for it, if its sources changed. Succeeds also without a page, as the program runs without it.
build_page() {
    local folder="$PWD/$1/share/motionrack/page" stamp="$1/.page-made-of" want log shown
    shown="a text in its place"
    [ ! -e "$folder/index.html" ] || shown="the page that was built before"
    if ! page_node_is_new || ! page_packages; then
        say "the program shows $shown"
        return 0
    fi
    want=$(find hmi -path hmi/node_modules -prune -o -path hmi/test -prune -o -type f -print0 |
        sort -z | xargs -0 sha256sum | sha256sum)
    [ -e "$folder/index.html" ] && [ "$(cat "$stamp" 2>/dev/null)" = "$want" ] && return 0
    say "building the operator panel's page"
    log=$(mktemp)
    if ! (cd hmi && MOTIONRACK_PAGE="$folder" npm run build) >"$log" 2>&1; then
        tail -n 15 "$log" >&2
        no_room "$folder" || say "the page could not be built; the whole log is $log. Mend what it names in hmi/src."
        say "the program shows $shown"
        return 0
    fi
    rm -f "$log"
    printf '%s' "$want" >"$stamp"
}
