#!/usr/bin/env bash
# Makes the documentation site: one folder of pages that opens without a server.
# usage: ./docs.sh [OUT]   OUT: folder of the pages, default build/docs
set -euo pipefail
case "${1:-}" in
  -h | --help)
    sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
esac
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
out="$(realpath -m "${1:-$here/build/docs}")"
cd "$here"
. tools/setup.sh

# Beside what the build needs: the module is imported for its pages.
buckens_packages+=(python3-sphinx python3-myst-parser furo doxygen libjs-katex)
buckens_setup
if [ ! -e build/release/python/buckens/objects.py ] || ! compgen -G "build/release/python/buckens/_core*.so" >/dev/null; then
  configure_release -DBUCKENS_PYTHON_MODULE=ON
  say "Building the Python module for its pages"
  build_release buckens_python buckens_python_objects
fi

pages="$(mktemp -d)"
trap 'rm -rf "$pages"' EXIT
say "Pages of the C++ library"
# The public headers: all of ours that include/buckens/buckens.h includes. -MG: those of libraries need not be found.
headers="$(clang++-14 -x c++ -std=c++20 -MM -MG -Iinclude -Isrc -Ibuild/release/generated -isystem /usr/include/eigen3 include/buckens/buckens.h |
  tr -s ' \\\n' '\n' | grep -E '^(include|src)/.*\.h$' | tr '\n' ' ')"
sed -e "s,@OUTPUT@,$pages," -e "s,@HEADERS@,$headers," docs/site/Doxyfile.in >"$pages/Doxyfile"
doxygen "$pages/Doxyfile" >/dev/null
rm "$pages/Doxyfile"

say "All other pages"
BUCKENS_CPP_PAGES="$pages" sphinx-build -q -j auto -c docs/site -d "$out/.doctrees" -b html . "$out"
cat >"$out/index.html" <<'HTML'
<!doctype html>
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url=docs/site/index.html">
<title>Buckens</title>
<a href="docs/site/index.html">Buckens: documentation</a>
HTML
say "The documentation; open it in a browser:"
echo "  $out/index.html"
