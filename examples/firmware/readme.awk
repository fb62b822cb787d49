# readme.awk - holds the flash that README names against rows of the table: README.md, then files of rows.
# The sentence may be broken into lines.
FILENAME ~ /README/ {
  gsub(/^ +/, "")
  text = text " " $0
  if (match(text, /the proof takes [0-9]+ KB of flash, the network [0-9]+\./)) {
    split(substr(text, RSTART, RLENGTH), word, " ")
    named["proof"] = word[4]
    named["network"] = word[10] + 0
  }
}
/^\| (proof|network) \| Cortex-M4F -O2 / {
  split($2, build, " ")
  off = named[build[1]] - ($4 + 0)
  checked++
  if (off > 3 || off < -3) {
    printf "README: %d KB of flash for the %s, and it is%s\n", named[build[1]], build[1], $4
    bad = 1
  }
}
END { exit bad || checked != 2 }
