# given.awk - what is wrong with what `make own` was given, in one line; nothing if all is well.
# Variables, "" where it was not given: a, b: files. from, to: x,y,z. scale: S or S,S.

# C takes 010 for 8.
function is_number(text) {
  return text ~ /^[-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?$/
}
function are_numbers(text, least, most,    count, part, i) {
  count = split(text, part, ",")
  for (i = 1; i <= count; i++)
    if (!is_number(part[i])) return 0
  return count >= least && count <= most
}
function are_scales(text,    count, part, i) {
  count = split(text, part, ",")
  for (i = 1; i <= count; i++)
    if (part[i] + 0 < 1e-6 || part[i] + 0 > 1e6) return 0
  return are_numbers(text, 1, 2)
}
function lacks(name, value, other, other_value) {
  if (value != "" && other_value == "") return name " without " other ": give both, or neither"
  return ""
}
BEGIN {
  wrong = lacks("FROM", from, "TO", to) lacks("TO", to, "FROM", from)
  if (!wrong) wrong = lacks("A", a, "B", b) lacks("B", b, "A", a)
  if (!wrong && from != "" && !are_numbers(from, 3, 3)) wrong = "FROM=" from ": not three numbers, as 0,0,2"
  if (!wrong && to != "" && !are_numbers(to, 3, 3)) wrong = "TO=" to ": not three numbers, as 0,0,2"
  if (!wrong && scale != "" && !are_scales(scale))
    wrong = "SCALE=" scale ": not a number in 1e-6..1e6, nor one for A and one for B: 0.001,1"
  if (wrong) print wrong
}
