# readme.awk - holds the flash that README names against rows of the table: README.md, then files of rows.
match($0, /in [0-9]+ KB of flash by proof, in [0-9]+ by the network/) {
  split(substr($0, RSTART, RLENGTH), word, " ")
  named["proof"] = word[2]
  named["network"] = word[9]
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
