# readme.awk - holds the flash that README names against rows of the table: README.md, then files of rows.
# The sentence may be broken into lines.
FILENAME ~ /README/ {
  gsub(/^ +/, "")
  text = text " " $0
}
/^\| (proof|network) \| Cortex-M4F -O2 / {
  split($2, build, " ")
  taken[build[1]] = $4 + 0
}
END {
  if (!match(text, /the proof takes [0-9]+ KB of flash, the network [0-9]+\./)) exit 1
  split(substr(text, RSTART, RLENGTH), word, " ")
  named["proof"] = word[4] + 0
  named["network"] = word[10] + 0
  for (name in named) {
    off = named[name] - taken[name]
    if (!(name in taken) || off > 3 || off < -3) {
      printf "README: %d KB of flash for the %s, and it is %d\n", named[name], name, taken[name]
      bad = 1
    }
  }
  exit bad
}
