// options.h - a command line by a table: `--name value`, `--name=value` and `--flag`, in any order
// among paths. What is wrong is named, with what was perhaps meant. Include problem_file.h first.
#ifndef NSVCD_SCENERY_OPTIONS_H
#define NSVCD_SCENERY_OPTIONS_H

typedef enum option_kind {
  OPTION_FLAG,    // int, set to 1
  OPTION_COUNT,   // size_t, low to high
  OPTION_NUMBER,  // float, low to high
  OPTION_LENGTH,  // float[2]: a number, low to high; or, followed by an m, metres, and the number 0
  OPTION_WORD,    // int: low for the first of the words in `text`, and so on
  OPTION_TEXT     // const char *, as it stands
} option_kind;

typedef struct option {
  const char *name;   // "--points"
  unsigned commands;  // bits of the commands that have it
  option_kind kind;
  size_t offset;  // place of its value in the settings
  double low, high;
  const char *text;   // "one|two" words, or NULL, or the name of the limit
  const char *value;  // what stands behind it in the manual; NULL: the words, or nothing
  const char *help;   // what it means; NULL: it is not in the manual
} option;

// ------------------------------------------------------------------------------------ did you mean

#define OPTION_WORD_MOST 24

// Letters to be changed, added or left out to make b of a (Wagner and Fischer 1974); long words are
// far from all.
static size_t edit_distance(const char *a, const char *b) {
  size_t row[OPTION_WORD_MOST + 1];
  const size_t n = strlen(a);
  const size_t m = strlen(b);
  if (n > OPTION_WORD_MOST || m > OPTION_WORD_MOST) return OPTION_WORD_MOST;
  for (size_t j = 0; j <= m; j++) row[j] = j;
  for (size_t i = 1; i <= n; i++) {
    size_t corner = row[0];
    row[0] = i;
    for (size_t j = 1; j <= m; j++) {
      const size_t above = row[j];
      const size_t least = (above < row[j - 1] ? above : row[j - 1]) + 1;
      const size_t changed = corner + (a[i - 1] != b[j - 1]);
      row[j] = changed < least ? changed : least;
      corner = above;
    }
  }
  return row[m];
}

// Takes `name` for *meant if less than half of `word` is wrong, and less than what was found
// before; *distance begins at 3.
static void consider(const char *word, const char *name, const char **meant, size_t *distance) {
  const size_t d = edit_distance(word, name);
  if (d < *distance && 2 * d < strlen(word)) {
    *meant = name;
    *distance = d;
  }
}

// --------------------------------------------------------------------------------------- the table

static int take_word(const option *o, const char *value, int *out) {
  const size_t length = strlen(value);
  int word = (int)o->low;
  for (const char *at = o->text; at; at = strchr(at, '|'), word++) {
    at += *at == '|';
    if (length && strcspn(at, "|") == length && strncmp(at, value, length) == 0) {
      *out = word;
      return 1;
    }
  }
  return 0;
}

// "0.5", or "0.5m".
static int take_length(const option *o, const char *value, float *out) {
  char number[64];
  const size_t length = strlen(value);
  const int is_metres = length > 1 && value[length - 1] == 'm';
  float taken;
  if (length >= sizeof number) return 0;
  snprintf(number, sizeof number, "%.*s", (int)(length - (size_t)is_metres), value);
  if (!parse_float(number, &taken) || (double)taken < o->low) return 0;
  if ((double)taken > (is_metres ? (double)NSVCD_MAX_COORDINATE : o->high)) return 0;
  out[is_metres] = taken;
  out[!is_metres] = 0;
  return 1;
}

static int take_value(const option *o, const char *value, void *settings) {
  char *place = (char *)settings + o->offset;
  float number;
  if (o->kind == OPTION_FLAG) *(int *)(void *)place = 1;
  if (o->kind == OPTION_TEXT) *(const char **)(void *)place = value;
  if (o->kind == OPTION_WORD) return take_word(o, value, (int *)(void *)place);
  if (o->kind == OPTION_LENGTH) return take_length(o, value, (float *)(void *)place);
  if (o->kind == OPTION_COUNT)
    return parse_count(value, (size_t)o->low, (size_t)o->high, (size_t *)(void *)place);
  if (o->kind == OPTION_NUMBER) {
    if (!parse_float(value, &number) || (double)number < o->low || (double)number > o->high)
      return 0;
    *(float *)(void *)place = number;
  }
  return 1;
}

static int refuse_value(const option *o, const char *value) {
  char words[64];
  const char *limit = o->text ? o->text : "";
  snprintf(words, sizeof words, "%s", limit);
  for (char *c = words; *c; c++) *c = *c == '|' ? ' ' : *c;
  char *unit;
  strtod(value, &unit);
  const int is_other = unit != value && *unit && strcmp(unit, o->kind == OPTION_LENGTH ? "m" : "");
  if (is_other && o->value && strstr(o->value, "METRES"))
    complain("%s %s: expected metres, as 0.005%s", o->name, value,
             o->kind == OPTION_LENGTH ? "m, or a fraction of the motion, as 0.001" : "");
  else if (o->kind == OPTION_WORD)
    complain("%s %s: none of: %s", o->name, value, words);
  else
    complain("%s %s: out of range: not a %s in %.9g..%.9g%s%s%s", o->name, value,
             o->kind == OPTION_COUNT ? "whole number" : "number", o->low, o->high,
             *limit ? " (" : "", limit, *limit ? ")" : "");
  return USAGE;
}

typedef struct command_line {
  const option *options;
  size_t option_count;
  unsigned command;
  const char *name;  // the command's, for messages
  char **arguments;
  int count;
} command_line;

static const option *find_option(const command_line *line, const char *name, size_t length) {
  for (size_t i = 0; i < line->option_count; i++) {
    const option *o = &line->options[i];
    if ((o->commands & line->command) && strlen(o->name) == length &&
        strncmp(o->name, name, length) == 0)
      return o;
  }
  return NULL;
}

static int refuse_option(const command_line *line, const char *argument) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(argument, "="), argument);
  const char *meant = NULL;
  size_t distance = 3;
  for (size_t i = 0; i < line->option_count; i++)
    if (line->options[i].commands & line->command)
      consider(name, line->options[i].name, &meant, &distance);
  if (meant)
    complain("%s: %s has no such option; did you mean %s?", name, line->name, meant);
  else
    complain("%s: %s has no such option; '" PROGRAM " %s --help' lists them", name, line->name,
             line->name);
  return USAGE;
}

// The option at argument *i; leaves *i at the last argument that it takes.
static int take_option(const command_line *line, int *i, void *settings) {
  const char *name = line->arguments[*i];
  const size_t length = strcspn(name, "=");
  const char *value = name[length] ? name + length + 1 : NULL;
  const option *o = find_option(line, name, length);
  if (!o) return refuse_option(line, name);
  if (o->kind == OPTION_FLAG && value) return complain("%s: takes no value", name), USAGE;
  if (o->kind != OPTION_FLAG && !value && *i + 1 == line->count)
    return complain("%s: a value is missing", name), USAGE;
  if (o->kind != OPTION_FLAG && !value) value = line->arguments[++*i];
  return take_value(o, value, settings) ? DONE : refuse_value(o, value);
}

// Takes all options into `settings`, and everything else as a path, up to `most` of them. DONE, or
// USAGE after a complaint.
static int take_options(const command_line *line, void *settings, const char **paths, size_t most,
                        size_t *path_count) {
  *path_count = 0;
  for (int i = 0; i < line->count; i++) {
    const char *argument = line->arguments[i];
    if (argument[0] == '-' && argument[1]) {
      const int status = take_option(line, &i, settings);
      if (status != DONE) return status;
    } else if (*path_count == most) {
      complain("%s: one file too many: %s takes %zu", argument, line->name, most);
      return USAGE;
    } else {
      paths[(*path_count)++] = argument;
    }
  }
  return DONE;
}

#endif
