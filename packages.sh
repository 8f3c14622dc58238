#!/usr/bin/env bash
# Makes the Debian packages: program, library, Python module, documentation. They fit the release of Debian on which they are made.
# usage: ./packages.sh [--without-docs]   the packages appear in build/release/packages
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
with_docs=yes
case "${1:-}" in
  -h | --help)
    sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
  --without-docs) with_docs=no ;;
  "") ;;
  *)
    printf 'error: unknown argument %s; usage: ./packages.sh [--without-docs]\n' "$1" >&2
    exit 2
    ;;
esac
. tools/setup.sh

buckens_packages=("${buckens_build_packages[@]}" python3 python3-dev python3-numpy pybind11-dev dpkg-dev file lintian)
buckens_needs_browser=no
buckens_setup
only=()
[ -f build/release/CMakeCache.txt ] || only=(-DBUCKENS_TESTS=OFF -DBUCKENS_BENCH=OFF)
configure_release -DBUCKENS_PYTHON_MODULE=ON "${only[@]}"
say "Building (preset release)"
build_release buckens buckens_program buckens_viewer buckens_python buckens_python_objects
if [ "$with_docs" = yes ]; then
  ./docs.sh
  configure_release  # which looks whether there are pages
fi
say "Packing"
rm -rf build/release/packages
(cd build/release && cpack -G DEB >packages.log 2>&1) || {
  cat build/release/packages.log >&2
  fail "cpack failed; see the lines above."
}
say "Checking with lintian"
lintian --fail-on error --suppress-tags bad-distribution-in-changes-file build/release/packages/*.deb
say "The packages; install them with: apt-get install ./NAME.deb"
ls -sh1 build/release/packages/*.deb
