#!/usr/bin/env bash
# C++ layout: clang-format 14 with the .clang-format of the repository. `--fix` rewrites the files.
set -euo pipefail
mode=(--dry-run -Werror)
if [ "${1:-}" = --fix ]; then
  mode=(-i)
  shift
fi
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
if ! command -v clang-format-14 >/dev/null; then
  echo "format: clang-format-14 is not installed" >&2
  exit 1
fi
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
  # A file deleted but not yet committed is still listed.
  list() {
    local name
    git ls-files -co --exclude-standard -z -- '*.h' '*.cpp' | while IFS= read -r -d '' name; do
      if [ -f "$name" ]; then printf '%s\0' "$name"; fi
    done
  }
else
  list() { find . -name build -prune -o -name node_modules -prune -o \
    \( -name '*.h' -o -name '*.cpp' \) -print0; }
fi
if ! list | xargs -0 --no-run-if-empty clang-format-14 "${mode[@]}"; then
  echo "format: errors; tools/check_format.sh --fix rewrites the files" >&2
  exit 1
fi
echo "format: ok"
