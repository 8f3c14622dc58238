#!/usr/bin/env bash
# Tests the decisions of tools/setup.sh with stand-ins for the package system; installs nothing.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"
failures=0

expect() {  # expect WHAT WANTED GOT
  if [ "$2" != "$3" ]; then
    printf 'FAILED: %s\n  wanted: %s\n  got:    %s\n' "$1" "$2" "$3"
    failures=$((failures + 1))
  fi
}
expect_words() {  # expect_words WHAT WORDS TEXT
  case "$3" in *"$2"*) ;; *) expect "$1" "...$2..." "$3" ;; esac
}

real_installed="$(declare -f installed_packages)"
all="$(printf '%s\n' "${buckens_packages[@]}")"

has_command() { true; }
find_chromium() { echo chromium; }
installed_packages() { echo "$all"; }
expect "nothing is missing" "" "$(missing_packages)"
expect "nothing to do makes no noise" "" "$(install_debian_packages 2>&1)"

installed_packages() { grep -v -e muparser -e '^clang-14$' <<<"$all"; }
expect "two packages are missing" "clang-14 libmuparser-dev " "$(missing_packages | tr '\n' ' ')"

installed_packages() { true; }
expect "everything is missing" "${#buckens_packages[@]}" "$(missing_packages | wc -l)"

installed_packages() { echo "$all"; }
has_command() { [ "$1" != npm ] && [ "$1" != node ]; }
find_chromium() { return 1; }
expect "programs count by their command" "nodejs npm chromium fonts-liberation " "$(missing_packages | tr '\n' ' ')"

buckens_needs_browser=no
expect "a browser only where one is needed" "nodejs npm " "$(missing_packages | tr '\n' ' ')"
buckens_needs_node=no
expect "Node.js only where it is needed" "" "$(missing_packages | tr '\n' ' ')"
buckens_needs_node=yes
buckens_needs_browser=yes
for package in "${buckens_build_packages[@]}"; do
  expect_words "packages of the build are among all" "$package" "$all"
done

# Neither root nor sudo.
has_command() { [ "$1" != sudo ]; }
find_chromium() { echo chromium; }
installed_packages() { grep -v muparser <<<"$all"; }
id() { echo 1000; }
if got="$(install_debian_packages 2>&1)"; then expect "refusal without sudo" failure success; fi
expect_words "message without sudo" "apt-get install libmuparser-dev" "$got"

# An ordinary user with sudo: only apt-get runs under it.
has_command() { true; }
sudo() { echo "sudo $*" >>"$log"; }
log="$(mktemp)"
install_debian_packages >/dev/null
expect_words "sudo is used" "apt-get install -y" "$(cat "$log")"
expect_words "only what is missing" "--no-install-recommends libmuparser-dev" "$(tail -n 1 "$log")"

# apt-get fails.
sudo() { return 100; }
if got="$(install_debian_packages 2>&1)"; then expect "failing apt-get" failure success; fi
expect_words "message of a failing apt-get" "could not install: libmuparser-dev" "$got"

# What makes the page is installed beside other work; its messages appear where it fails.
root_prefix() { echo ""; }
make_page() { echo "page made" >"$made"; }
made="$(mktemp)"
install_page_packages() { echo "npm ci failed"; return 1; }
start_page_setup
status=0
finish_page_setup 2>"$log" || status=$?
expect "failing set-up of the page" 1 "$status"
expect "its messages" "npm ci failed" "$(cat "$log")"
expect "no page without its packages" "" "$(cat "$made")"
install_page_packages() { echo "fine"; }
start_page_setup
finish_page_setup 2>"$log"
expect "a set-up that succeeds is silent" "" "$(cat "$log")"
expect "the page is made beside the build" "page made" "$(cat "$made")"
rm -f "$made"

# Another system: prints the list and continues.
is_debian() { false; }
if ! got="$(install_debian_packages 2>&1)"; then expect "other systems go on" success failure; fi
expect_words "list for other systems" "libsuitesparse-dev" "$got"

# The real query, with a stand-in for dpkg-query: half-installed does not count.
eval "$real_installed"
dpkg-query() { printf 'ii cmake\nrc ninja-build\nun ccache\n'; return 1; }
expect "states of dpkg" "cmake" "$(installed_packages cmake ninja-build ccache)"
rm -f "$log"

# How far ninja is; errors are passed on.
progress() { printf '@1 40 Building a\n@2 40 Building b\nb.cpp:3: error: no\n@40 40 Linking c\n' | show_progress; }
unset SECONDS  # it counts no more: a busy machine may take a second
SECONDS=0
expect "progress, now and then" "  1 of 40 steps, 0 s
b.cpp:3: error: no
  40 of 40 steps, 0 s" "$(progress)"
expect "an estimate" "  10 of 40 steps, 50 s, about 3 min to go" "$(progress_text 10 40 50)"

# The compiler's memory, unless the user has settings of the kind.
cmake() { echo "tunables $GLIBC_TUNABLES"; }
expect_words "large pages for the compiler" "tunables glibc.malloc.hugetlb=1" "$(build_release all)"
expect_words "settings of the user" "tunables glibc.malloc.arena_max=1" "$(GLIBC_TUNABLES=glibc.malloc.arena_max=1 build_release all)"

if [ "$failures" -gt 0 ]; then
  echo "setup: $failures failure(s)"
  exit 1
fi
echo "setup: ok"
