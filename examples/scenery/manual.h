// manual.h - what a command line says of itself, from one table of commands and one of options: help,
// a man page, completions for bash, zsh and fish. Include options.h first.
#ifndef NSVCD_SCENERY_MANUAL_H
#define NSVCD_SCENERY_MANUAL_H

typedef struct settings settings;  // the program's own

typedef struct command {
  const char *name;
  unsigned bit;  // the bit that its options have set
  int (*run)(settings *options);
  size_t paths;         // the most that it takes
  const char *files;    // their names in the manual
  const char *summary;  // a line
  const char *text;     // what it does
} command;

typedef struct manual {
  const char *name, *version, *summary;
  const char *text;  // what all commands share
  const command *commands;
  size_t command_count;
  const option *options;
  size_t option_count;
  // a program that goes with this one: its name, what it takes, what it does
  const char *other, *other_files, *other_text;
} manual;

#define MANUAL_WIDTH 80
#define MANUAL_INDENT 24

// Is it in the manual of these commands?
static int manual_has(const option *o, unsigned commands) {
  return o->help && (o->commands & commands);
}
// What stands behind an option; "" where nothing does.
static const char *manual_value(const option *o) {
  return o->value ? o->value : o->kind == OPTION_WORD ? o->text : "";
}

// Words of a text, from a column on, in lines that begin at `indent`.
static void manual_wrap(FILE *out, const char *text, size_t column, size_t indent) {
  while (*text) {
    const size_t length = strcspn(text, " ");
    if (column > indent && column + 1 + length > MANUAL_WIDTH) {
      fprintf(out, "\n%*s", (int)indent, "");
      column = indent;
    } else if (column > indent) {
      putc(' ', out);
      column++;
    }
    fprintf(out, "%.*s", (int)length, text);
    column += length;
    text += length + (text[length] == ' ');
  }
  putc('\n', out);
}

static void manual_help(FILE *out, const manual *m, const command *c) {
  fprintf(out, "%s %s %s[OPTIONS]\n", m->name, c->name, c->files);
  manual_wrap(out, c->text, 0, 0);
  for (size_t i = 0; i < m->option_count; i++) {
    const option *o = &m->options[i];
    if (!manual_has(o, c->bit)) continue;
    const int wide = fprintf(out, "  %s %s", o->name, manual_value(o));
    const int fits = wide + 1 < MANUAL_INDENT;
    fprintf(out, "%s%*s", fits ? "" : "\n", fits ? MANUAL_INDENT - wide : MANUAL_INDENT, "");
    manual_wrap(out, o->help, MANUAL_INDENT, MANUAL_INDENT);
  }
}

static void manual_overview(FILE *out, const manual *m) {
  fprintf(out, "%s - %s\n", m->name, m->summary);
  for (size_t i = 0; i < m->command_count; i++) {
    const command *c = &m->commands[i];
    const int wide = fprintf(out, "  %s %s %s", m->name, c->name, c->files);
    fprintf(out, "%*s%s\n", wide < 32 ? 32 - wide : 1, "", c->summary);
  }
  manual_wrap(out, m->text, 0, 0);
}

// For roff: a line that begins with a point or an apostrophe would be a request.
static void manual_escaped(FILE *out, const char *text) {
  for (; *text; text++) {
    if (*text == '-' || *text == '\\') putc('\\', out);
    putc(*text == '\\' ? 'e' : *text, out);
  }
}
static void manual_roff(FILE *out, const char *text) {
  if (*text == '.' || *text == '\'') fprintf(out, "\\&");
  manual_escaped(out, text);
  putc('\n', out);
}

static void manual_page(FILE *out, const manual *m) {
  fprintf(out, ".TH %s 1 \"\" \"%s %s\"\n.SH NAME\n", m->name, m->name, m->version);
  fprintf(out, "%s, ", m->name);
  manual_escaped(out, m->other);
  fprintf(out, " \\- ");
  manual_roff(out, m->summary);
  fprintf(out, ".SH SYNOPSIS\n.nf\n");
  for (size_t i = 0; i < m->command_count; i++)
    fprintf(out, "\\fB%s %s\\fR %s[OPTIONS]\n", m->name, m->commands[i].name, m->commands[i].files);
  fprintf(out, "\\fB");
  manual_escaped(out, m->other);
  fprintf(out, "\\fR ");
  manual_roff(out, m->other_files);
  fprintf(out, ".fi\n.SH DESCRIPTION\n");
  manual_roff(out, m->text);
  for (size_t i = 0; i < m->command_count; i++) {
    const command *c = &m->commands[i];
    fprintf(out, ".SH %s %s\n", m->name, c->name);
    manual_roff(out, c->text);
    for (size_t k = 0; k < m->option_count; k++) {
      const option *o = &m->options[k];
      if (!manual_has(o, c->bit)) continue;
      fprintf(out, ".TP\n\\fB\\-\\-%s\\fR %s\n", o->name + 2, manual_value(o));
      manual_roff(out, o->help);
    }
  }
  fprintf(out, ".SH ");
  manual_roff(out, m->other);
  manual_roff(out, m->other_text);
}

// Prints all names, with blanks between.
static void manual_names(FILE *out, const manual *m, unsigned bit) {
  for (size_t i = 0; i < (bit ? m->option_count : m->command_count); i++) {
    if (bit && !manual_has(&m->options[i], bit)) continue;
    fprintf(out, " %s", bit ? m->options[i].name : m->commands[i].name);
  }
}

// Words after an option that has them, else the command's options or files. zsh understands it too.
static void manual_bash(FILE *out, const manual *m) {
  fprintf(out, "_%s() {\n  local word=${COMP_WORDS[COMP_CWORD]} names=\n", m->name);
  fprintf(out, "  case ${COMP_WORDS[COMP_CWORD - 1]} in\n");
  for (size_t i = 0; i < m->option_count; i++) {
    const option *o = &m->options[i];
    if (o->kind != OPTION_WORD) continue;
    fprintf(out, "    %s) names=\"", o->name);
    for (const char *c = o->text; *c; c++) putc(*c == '|' ? ' ' : *c, out);
    fprintf(out, "\" word=${word:--} ;;\n");
  }
  fprintf(out, "  esac\n  if [ -n \"$names\" ]; then\n");
  fprintf(out, "    COMPREPLY=($(compgen -W \"$names\" -- \"${word#-}\"))\n    return\n  fi\n");
  fprintf(out, "  case ${COMP_WORDS[1]} in\n");
  for (size_t i = 0; i < m->command_count; i++) {
    fprintf(out, "    %s) names=\"", m->commands[i].name);
    manual_names(out, m, m->commands[i].bit);
    fprintf(out, "\" ;;\n");
  }
  fprintf(out, "  esac\n  if [ \"$COMP_CWORD\" = 1 ]; then names=\"");
  manual_names(out, m, 0);
  fprintf(out, "\"; elif [ \"${word#-}\" = \"$word\" ]; then names=; fi\n");
  fprintf(out, "  COMPREPLY=($(compgen -W \"$names\" -- \"$word\"))\n}\n");
  fprintf(out, "complete -o default -F _%s %s\n", m->name, m->name);
}

static void manual_zsh(FILE *out, const manual *m) {
  fprintf(out, "#compdef %s\nautoload -U +X bashcompinit && bashcompinit\n", m->name);
  manual_bash(out, m);
}

// A word of fish, in quotes.
static void manual_quoted(FILE *out, const char *text) {
  putc('\'', out);
  for (; *text; text++) {
    if (*text == '\'' || *text == '\\') putc('\\', out);
    putc(*text == '|' ? ' ' : *text, out);
  }
  putc('\'', out);
}
static void manual_fish(FILE *out, const manual *m) {
  for (size_t i = 0; i < m->command_count; i++) {
    const command *c = &m->commands[i];
    fprintf(out, "complete -c %s -n __fish_use_subcommand -f -a %s -d ", m->name, c->name);
    manual_quoted(out, c->summary);
    fprintf(out, "\n");
    for (size_t k = 0; k < m->option_count; k++) {
      const option *o = &m->options[k];
      if (!manual_has(o, c->bit)) continue;
      fprintf(out, "complete -c %s -n '__fish_seen_subcommand_from %s' -l %s", m->name, c->name,
              o->name + 2);
      if (o->kind == OPTION_WORD) fprintf(out, " -x -a "), manual_quoted(out, o->text);
      if (o->kind != OPTION_FLAG && o->kind != OPTION_WORD) fprintf(out, " -r");
      fprintf(out, " -d ");
      manual_quoted(out, o->help);
      fprintf(out, "\n");
    }
  }
}

// Prints the manual in a form: man, bash, zsh or fish. Returns 0 if there is no such form.
static int manual_print(FILE *out, const manual *m, const char *form) {
  static const struct {
    const char *form;
    void (*print)(FILE *out, const manual *m);
  } forms[] = {
      {"man", manual_page}, {"bash", manual_bash}, {"zsh", manual_zsh}, {"fish", manual_fish}};
  for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
    if (strcmp(form, forms[i].form) != 0) continue;
    forms[i].print(out, m);
    return 1;
  }
  return 0;
}

#endif
