#!/bin/sh
# Has gappa prove how far the checker's sums are off at most, which its margins hold: formal/margins.
# In single precision, and without what is added for roundings, none of them may hold.
cd "$(dirname "$0")/margins" || exit 1
command -v gappa >/dev/null || { echo "margins: gappa: not tested"; exit 0; }
proves() {
  timeout 60 gappa 2>/dev/null >/dev/null
}
for file in *.gappa; do
  proves <"$file" || { echo "margins: $file is not proven"; exit 1; }
  sed 's/ieee_64/ieee_32/; s/0\.1250001/0.125/; s/\([01]\)\.000001/\1/g' "$file" | proves &&
    { echo "margins: $file proves anything"; exit 1; }
done
echo "margins: $(ls *.gappa | wc -l) bounds are proven, and in single precision none"
