#!/usr/bin/env bash
# Every work cited in a comment as [Authors Year] is in docs/bibliography.md, and every work there is
# cited somewhere. Run by CTest: check_citations.sh REPOSITORY
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$1"

pattern='\[[[:upper:]][[:alpha:] ,.-]* (19|20)[0-9]{2}'
sources=(core raster_cpu raster_gl compare apps tests benchmarks)
pages=(README.md scripts/*.sh)
for page in docs/*.md; do
  [ "$page" = docs/bibliography.md ] || pages+=("$page")
done

# "[A 1990; B 1995]" cites two works.
separate() { sed 's/; \([[:upper:]]\)/] [\1/g'; }

cited=$(grep -rh --include='*.h' --include='*.cpp' '' "${sources[@]}" | separate |
  grep -oE "$pattern" | sort -u)
[ -n "$cited" ] || { echo "no citation found: is this the repository?"; exit 1; }
cited_in_pages=$(cat "${pages[@]}" | separate | grep -oE "$pattern" | sort -u)
listed=$(grep -oE "^- $pattern" docs/bibliography.md | sed 's/^- //' | sort -u)

missing=$(comm -23 <(printf '%s\n' "$cited" "$cited_in_pages" | grep . | sort -u) <(echo "$listed"))
unused=$(comm -13 <(printf '%s\n' "$cited" "$cited_in_pages" | grep . | sort -u) <(echo "$listed"))
[ -z "$missing" ] || printf 'cited but not in docs/bibliography.md:\n%s\n' "$missing"
[ -z "$unused" ] || printf 'in docs/bibliography.md but cited nowhere:\n%s\n' "$unused"
[ -z "$missing$unused" ]
