# row.awk - rows of the table, a method each: from `size -A` of an image, then what it printed.
# Variables: build, board, level.

$1 == ".text" || $1 == ".rodata" || $1 == ".data" || $1 == ".ARM.exidx" { flash += $2 }
$1 == ".bodies" { bodies = $2 }

$1 == "#" {
  if (!($2 in seen)) methods[++count] = $2
  seen[$2] = 1
  amount[$2, $3] = $4
}

function kilobytes(bytes) { return sprintf("%.1f KB", bytes / 1024) }
function millions(instructions) { return sprintf("%.2f M", instructions / 1e6) }

END {
  if (!count) {
    print build, board, level ": the clock does not count instructions" >"/dev/stderr"
    exit 1
  }
  for (i = 1; i <= count; i++) {
    m = methods[i]
    name = count > 1 ? build (build == "verify" ? ", " : ", by ") m : build
    held = kilobytes(bodies)
    if ((m, "certificates") in amount)
      held = held ", of it certificates " kilobytes(amount[m, "certificates"])
    printf "| %s | %s %s | %s | %s | %s | %s | %s / %s |\n", name, board, level, kilobytes(flash),
           held, kilobytes(amount[m, "workspace"]), kilobytes(amount[m, "stack"]),
           millions(amount[m, "mean"]), millions(amount[m, "worst"])
  }
}
