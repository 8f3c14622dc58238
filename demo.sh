#!/usr/bin/env bash
# Installs what is missing, builds the program, simulates the slider-crank and makes its page.
# usage: ./demo.sh [--mpi] [OUT]   OUT: run directory, default build/demo
# --mpi: also what large bodies need, PETSc and MPI (docs/tutorials/large.md)
set -euo pipefail
case "${1:-}" in
  -h | --help)
    sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
esac
with_mpi=no
if [ "${1:-}" = --mpi ]; then
  with_mpi=yes
  shift
fi
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
out="$(realpath -m "${1:-$here/build/demo}")"
cd "$here"
. tools/setup.sh

# Only what the demonstration needs, unless this is already configured for more.
buckens_packages=("${buckens_build_packages[@]}")
buckens_needs_node=no
buckens_needs_browser=no
[ "$with_mpi" = no ] || buckens_packages+=("${buckens_mpi_packages[@]}")
install_debian_packages
only=()
[ -f build/release/CMakeCache.txt ] || only=(-DBUCKENS_TESTS=OFF -DBUCKENS_BENCH=OFF -DBUCKENS_PYTHON_MODULE=OFF)
parts=(buckens_program)
what="the program"
if [ "$with_mpi" = yes ]; then
  only+=(-DBUCKENS_MPI=ON)
  parts+=(buckens_petsc)
fi
# Node.js and its packages are installed, and the page is made, while the program compiles.
if can_make_page; then
  parts+=(buckens_viewer)
  what+=" and the viewer page"
else
  say "Installing what makes the viewer page, and making it, beside the build"
  start_page_setup
fi
configure_release "${only[@]}"
say "Building $what"
build_release "${parts[@]}"
if [ "$what" = "the program" ]; then finish_page_setup; fi

program=build/release/bin/buckens
model=examples/slider_crank/slider_crank.yaml
say "Simulating $model"
"$program" run "$model" -o "$out"
"$program" view "$out"

page="$(find "$out" -maxdepth 1 -name '*.html' | head -n 1)"
if [ -z "$page" ]; then
  fail "\`buckens view\` wrote no page into $out."
fi
picture="$out/screenshot.png"
if [ -f viewer/scripts/screenshot.mjs ] && find_chromium >/dev/null; then
  if node viewer/scripts/screenshot.mjs "$page" "$picture" >/dev/null; then
    say "Picture of the page: $picture"
  else
    warn "no picture: headless Chromium could not show the page. The page itself is complete."
  fi
else
  warn "no picture: Chromium is not installed. The page itself is complete."
fi

say "The machine moves on this page; open it in a browser:"
echo "  $page"
cat <<TEXT

What to try next:
  $program run $model -o out --set bodies.rod.beam.elements=32
  $program check $model
  $program --help
  PYTHONPATH=build/release/python python3 -c "import buckens; help(buckens)"   # after ./test.sh, which builds the rest
  ls examples
TEXT
