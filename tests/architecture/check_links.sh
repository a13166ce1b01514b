#!/usr/bin/env bash
# Every page that a comment or another page refers to exists. Run by CTest: check_links.sh REPOSITORY
set -euo pipefail
cd "$1"

broken=0
complain() {
  echo "$1: refers to $2, which does not exist"
  broken=1
}

# docs/page.md, wherever it is named.
while IFS=: read -r file page; do
  [ -e "$page" ] || complain "$file" "$page"
done < <(grep -roE --include='*.h' --include='*.cpp' --include='*.md' --include='*.sh' \
  --include='*.cmake' --include=CMakeLists.txt 'docs/[a-z_-]+\.(md|json)' \
  README.md CONTRIBUTING.md docs core raster_cpu raster_gl compare apps cmake scripts benchmarks)

# [text](relative/path#anchor) in pages.
while IFS=: read -r file target; do
  path=${target%%#*}
  case "$path" in
    '' | http*) ;;
    *) [ -e "$(dirname "$file")/$path" ] || complain "$file" "$path" ;;
  esac
done < <(grep -roE '\]\([^) ]+\)' --include='*.md' README.md CONTRIBUTING.md docs benchmarks |
  sed -E 's/\]\(([^)]*)\)/\1/')
exit "$broken"
