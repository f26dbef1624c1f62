# A program's --help, as CLI11 writes it, to the list of options of a manual page.
# An entry is indented; what it means stands from column 30 on, in the next line where the entry itself is too long.
function plain(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  sub(/^[.']/, "\\\\\\&&", text)
  return text
}
function entry(head,   words, rest) {
  gsub(/:INT in|:FLOAT in/, " in", head)
  gsub(/TEXT:|FLOAT:|UINT:|INT:/, "", head)
  sub(/=- /, " ", head)
  required = sub(/ REQUIRED/, "", head)
  words = head
  sub(/ .*/, "", words)
  rest = substr(head, length(words) + 1)
  sub(/:\{/, " {", rest)
  rest = plain(rest)
  gsub(/,/, ",\\:", rest)   # a line may end there
  print ".TP"
  print "\\fB" plain(words) "\\fR" rest (required ? " (required)" : "")
}
{ line[NR] = $0 }
END {
  for (i = 1; i <= NR; ++i) {
    text = line[i]
    if (text ~ /^Usage:/ || text ~ /^Exit status:/ || text ~ /^ *\[.*required\]$/) continue
    if (text ~ /^ *(Options|Positionals|Subcommands):$/) {
      match(text, /[^ ]/)
      indent = RSTART + 1
      continue
    }
    if (text ~ /^\[Option Group: /) {
      sub(/^\[Option Group: /, "", text)
      sub(/\]$/, "", text)
      group = line[i + 1]
      gsub(/^ +| +$/, "", group)
      print ".PP\n" plain(text) " (" plain(group) "):"
      ++i
      continue
    }
    if (text == "") { indent = 0; continue }
    if (!indent) {
      # What the program is, then what its page says beside the options.
      if (i > 1) print ".PP"
      print plain(text)
      continue
    }
    column = 28 + indent
    if (substr(line[i + 1], 1, column) ~ /^ +$/ && length(line[i + 1]) > column) {
      entry(substr(text, indent + 1))
      ++i
      print plain(substr(line[i], column + 1))
    } else {
      head = substr(text, indent + 1, column - indent)
      gsub(/ +$/, "", head)
      entry(head)
      print plain(substr(text, column + 1))
    }
  }
}
