# memory.awk - holds workspace and deepest stack together against what a build may take: of the program's measurements,
# lines `# METHOD workspace|stack BYTES`. network, proof, verify: bytes; network_stack: of the stack alone, for the
# smallest network.
/^# [a-z]* workspace / { workspace[FILENAME, $2] = $4 }
/^# [a-z]* stack / {
  limit = $2 == "proof" ? proof : network
  if (FILENAME ~ /both/) limit = proof
  if (FILENAME ~ /verify/) limit = verify
  all = workspace[FILENAME, $2] + $4
  checked++
  if (!(all > 0 && all <= limit)) {
    printf "%s: %d bytes of workspace and stack, of %d\n", FILENAME, all, limit
    bad = 1
  }
  if (FILENAME ~ /network/ && !($4 < network_stack)) {
    printf "%s: %d bytes of stack, of %d\n", FILENAME, $4, network_stack
    bad = 1
  }
}
END { exit bad || checked == 0 }
