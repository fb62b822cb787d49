// srdf.h - of svcd pairs: which links need not be checked against each other, as an SRDF, of what is
// proven alone.
#ifndef NSVCD_SVCD_SRDF_H
#define NSVCD_SVCD_SRDF_H

#include "goals.h"

// What a line above the first scene says that two bodies keep.
static float clearance_above(const robot_file *file, const nsvcd_body_pair *pair) {
  for (size_t k = 0; k < file->clearance_count; k++)
    if (file->clearances[k].room == NSVCD_NONE &&
        robot_is_about(file->clearances[k].at, pair->a, pair->b))
      return file->clearances[k].metres;
  return 0;
}

// Need two bodies never be asked about? Those that are always nearer than they should be may be apart.
static int is_left_out(const robot_file *file, const nsvcd_body_pair *pair,
                       const nsvcd_range_answer *found) {
  if (found->meeting == NSVCD_MEETS_NEVER) return 1;
  return found->meeting == NSVCD_MEETS_ALWAYS && !(clearance_above(file, pair) > 0);
}

// The body that has the name of a body's link: urdf.py calls the others of a link LINK.2, LINK.3.
static size_t body_of_link(const robot_file *file, size_t n) {
  const robot_thing *thing = &file->things[n];
  const char *dot = strrchr(thing->name, '.');
  size_t number;
  if (!dot || !parse_count(dot + 1, 2, NSVCD_MAX_PARTS, &number)) return n;
  const size_t length = (size_t)(dot - thing->name);
  for (size_t k = 0; k < file->body_count; k++) {
    const robot_thing *other = &file->things[k];
    if (other->link == thing->link && strlen(other->name) == length &&
        strncmp(other->name, thing->name, length) == 0)
      return k;
  }
  return n;
}

// A name as an attribute.
static void srdf_name(FILE *out, const char *attribute, const char *name, size_t length) {
  static const char marks[] = "&<>\"";
  static const char *const words[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
  fprintf(out, " %s=\"", attribute);
  for (size_t k = 0; k < length; k++) {
    const char *mark = strchr(marks, name[k]);
    if (mark)
      fputs(words[mark - marks], out);
    else
      fputc(name[k], out);
  }
  fputc('"', out);
}

// What is known of two links by the pairs of their bodies.
typedef struct link_pair {
  size_t pairs, proven, always;
  double open;  // the largest fraction of values that is not decided
} link_pair;

static void srdf_line(FILE *out, const char *a, const char *b, const link_pair *found) {
  const int is_proven = found->proven == found->pairs;
  fprintf(out, "  <%s", is_proven ? "disable_collisions" : "enable_collisions");
  srdf_name(out, "link1", a, strlen(a));
  srdf_name(out, "link2", b, strlen(b));
  if (is_proven) fprintf(out, " reason=\"%s\"", found->always ? "Always" : "Never");
  fputs("/>", out);
  if (!is_proven && found->open > 0)
    fprintf(out, "  <!-- not decided: %.3g of all values -->", found->open);
  else if (!is_proven)
    fputs("  <!-- they meet, or come nearer than they should -->", out);
  fputc('\n', out);
}

// Two links are disabled if that is proven of all pairs of their bodies. Returns 0 after a complaint.
static int write_srdf(const char *path, const robot_file *file, size_t count,
                      const nsvcd_body_pair *asked, const nsvcd_range_answer *found) {
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  FILE *out = open_file(path, "w");
  if (!out) return complain("%s: %s", path, strerror(errno));
  fputs("<?xml version=\"1.0\"?>\n<robot", out);
  srdf_name(out, "name", name, strlen(name) - strlen(".srdf"));
  fputs(">\n  <!-- by svcd pairs: over all values of the joints, within their limits -->\n", out);
  for (size_t a = 0; a < file->body_count; a++) {
    for (size_t b = a + 1; b < file->body_count; b++) {
      link_pair links = {0, 0, 0, 0};
      for (size_t n = 0; n < count; n++) {
        const size_t of[2] = {body_of_link(file, asked[n].a), body_of_link(file, asked[n].b)};
        if (!robot_is_about(of, a, b)) continue;
        links.pairs++;
        links.proven += (size_t)is_left_out(file, &asked[n], &found[n]);
        links.always += found[n].meeting == NSVCD_MEETS_ALWAYS;
        if (found[n].open > links.open) links.open = found[n].open;
      }
      if (links.pairs) srdf_line(out, file->things[a].name, file->things[b].name, &links);
    }
  }
  fputs("</robot>\n", out);
  return close_written(out, path);
}

#endif
