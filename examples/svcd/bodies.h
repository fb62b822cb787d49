// bodies.h - svcd encode: a mesh becomes a body, in a file or as a C array. svcd info: what a mesh
// is, and what is wrong with it.
#ifndef NSVCD_SVCD_BODIES_H
#define NSVCD_SVCD_BODIES_H

#include "settings.h"

// "parts/my-mug.h" -> "my_mug_body".
static void array_name(const char *path, char *name, size_t size) {
  const char *base = file_name(path);
  int digit = isdigit((unsigned char)base[0]);  // a C name cannot begin with one
  snprintf(name, size, "%s%.*s_body", digit ? "_" : "",
           (int)(strlen(base) < 40 ? strlen(base) - 2 : 40), base);
  for (char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c)) *c = '_';
}

static void write_header(FILE *file, const char *in, const char *name, const nsvcd_body *body) {
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  const unsigned char *bytes = (const unsigned char *)body;
  fprintf(file,
          "// %s, encoded for neuralsvcd.h by `svcd encode`: %zu points. For %s-endian hosts.\n"
          "//   const nsvcd_body *body;\n"
          "//   nsvcd_result result = nsvcd_body_load(%s, sizeof %s, &body);\n"
          "#if defined(__cplusplus)\n"
          "alignas(%d)\n"
          "#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L\n"
          "_Alignas(%d)\n"
          "#elif defined(__GNUC__)\n"
          "__attribute__((aligned(%d)))\n"
          "#elif defined(_MSC_VER)\n"
          "__declspec(align(%d))\n"
          "#endif\n"
          "static const unsigned char %s[%zu] = {",
          in, facts.patches, bytes[0] == 'N' ? "little" : "big", name, name, NSVCD_ALIGNMENT,
          NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, name, facts.size);
  for (size_t i = 0; i < facts.size; i++) fprintf(file, "%s%d,", i % 24 ? "" : "\n    ", bytes[i]);
  fprintf(file, "\n};\n");
}

// May a body be written there? Only a body is overwritten: any other file may be the input, under
// another name. Returns 0 after a complaint.
static int may_write_body(const char *path) {
  char begin[5000] = "";
  FILE *file = open_file(path, "rb");
  const size_t size = file ? fread(begin, 1, sizeof begin - 1, file) : 0;
  if (file) fclose(file);
  const int is_blob = memcmp(begin, "NSVB", 4) == 0 || memcmp(begin, "BVSN", 4) == 0;
  const int is_array =
      memcmp(begin, "// ", 3) == 0 && strstr(begin, "encoded for neuralsvcd.h by") != NULL;
  if (size == 0 || (ends_with(path, ".h") ? is_array : is_blob)) return 1;
  return complain("%s: is there already, and is no body", path);
}

static int write_body(const char *in, const char *out, const nsvcd_body *body) {
  int header = ends_with(out, ".h");
  FILE *file = open_file(out, header ? "w" : "wb");
  if (!file) return complain("%s: %s", out, strerror(errno));
  if (header) {
    char name[64];
    array_name(out, name, sizeof name);
    write_header(file, in, name, body);
  } else {
    fwrite(body, 1, nsvcd_body_describe(body).size, file);
  }
  return close_written(file, out);
}

// The least and the greatest radius of the patches.
static void patch_radii(const nsvcd_body *body, float *least, float *most) {
  float centre[3], radius;
  *least = nsvcd_body_describe(body).radius;
  *most = 0;
  for (uint32_t i = 0; nsvcd_body_patch(body, i, centre, &radius); i++) {
    *least = fminf(*least, radius);
    *most = fmaxf(*most, radius);
  }
}

static void print_facts(const char *path, const nsvcd_body *body) {
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  float least, most;
  patch_radii(body, &least, &most);
  printf("%s: %zu points, %zu bytes\n", path, facts.patches, facts.size);
  if (facts.triangles)
    printf("triangles: %zu, in %zu listings, within %g m\n", facts.triangles,
           facts.stored_triangles, (double)facts.quantization_error);
  printf("bounding sphere: centre %g %g %g, radius %g m\n", (double)facts.centre[0],
         (double)facts.centre[1], (double)facts.centre[2], (double)facts.radius);
  printf("patch radius: mean %g, least %g, most %g m\n", (double)facts.mean_patch_radius,
         (double)least, (double)most);
}

// Writes the facts of a body as a member "body".
static void json_facts(json_out *j, const nsvcd_body *body) {
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  json_open(j, "body", '{');
  json_count(j, "patches", facts.patches);
  json_count(j, "bytes", facts.size);
  json_count(j, "triangles", facts.triangles);
  json_float(j, "quantum", (double)facts.quantization_error);
  json_floats(j, "centre", facts.centre, 3);
  json_float(j, "radius", (double)facts.radius);
  json_close(j, '}');
}
static void json_faults(json_out *j, const thing *t) {
  json_open(j, "wrong", '[');
  for (int i = 0; i < t->fault_count; i++) json_text(j, NULL, t->faults[i]);
  json_close(j, ']');
}

// Prints the new origin, with --recentre.
static void print_origin(const thing *t) {
  if (t->recentre)
    printf("origin: %.0f %.0f %.0f, in the file's units\n", t->origin[0], t->origin[1],
           t->origin[2]);
}
static void json_origin(json_out *j, const thing *t) {
  if (!t->recentre) return;
  json_open(j, "origin", '[');
  for (int k = 0; k < 3; k++) json_digits(j, NULL, t->origin[k], 17);
  json_close(j, ']');
}

static int encode_options(const settings *options) {
  const nsvcd_encode_options *encode = &options->encode;
  if (options->path_count != 2)
    return usage_error("encode", "expected IN and OUT.body or OUT.h ('svcd encode --help')");
  if (!ends_with(options->paths[1], ".body") && !ends_with(options->paths[1], ".h"))
    return usage_error(options->paths[1], "neither .body nor .h");
  if (encode->patches && encode->patch_radius > 0)
    return usage_error("--radius", "not together with --points");
  return DONE;
}

static int encode(settings *options) {
  const int status = encode_options(options);
  float scales[2];
  thing t;
  if (status != DONE || !take_scales(options->scale, 1, scales)) return USAGE;
  const char *out = options->paths[1];
  if (!may_write_body(out)) return REFUSED;
  int good = open_thing(options->paths[0], &t);
  if (good && t.is_body) good = complain("%s: this is a body already", t.path);
  t.recentre = options->recentre;
  good = good && take_mesh(&t, scales[0]) && encode_thing(&t, &options->encode) &&
         write_body(t.path, out, t.body);
  if (good && options->json) {
    json_out j = {stdout, 0};
    json_open(&j, NULL, '{');
    json_text(&j, "path", out);
    json_origin(&j, &t);
    json_faults(&j, &t);
    json_facts(&j, t.body);
    json_digits(&j, "milliseconds", 1e3 * t.taken, 4);
    json_end_line(&j);
  } else if (good) {
    warn_of(&t, t.fault_count);
    print_origin(&t);
    print_facts(out, t.body);
    printf("encoded in %.1f ms\n", 1e3 * t.taken);
  }
  free_thing(&t);
  return good ? DONE : REFUSED;
}

static void print_mesh(const thing *t) {
  const mesh_report *r = &t->report;
  printf("%s: %s %s: %zu triangle%s, %zu vertices\n", t->path,
         strchr("OS", t->format[0]) ? "an" : "a", t->format, r->triangles,
         r->triangles == 1 ? "" : "s", r->vertices);
  print_origin(t);
  printf("box: %.4g x %.4g x %.4g m, from %.4g %.4g %.4g to %.4g %.4g %.4g\n",
         r->high[0] - r->low[0], r->high[1] - r->low[1], r->high[2] - r->low[2], r->low[0],
         r->low[1], r->low[2], r->high[0], r->high[1], r->high[2]);
  printf("components: %zu, %zu of them closed", r->components, r->closed);
  if (r->inwards) printf(", %zu of these turned inwards: cavities, or inside out", r->inwards);
  printf("\narea: %.4g m2", r->area);
  if (r->closed && fabs(r->volume) > 0) printf(", volume of what is closed: %.4g m3", r->volume);
  printf("\n");
}

static void json_mesh(json_out *j, const thing *t) {
  const mesh_report *r = &t->report;
  json_text(j, "format", t->format);
  json_origin(j, t);
  json_count(j, "triangles", r->triangles);
  json_count(j, "vertices", r->vertices);
  for (int side = 0; side < 2; side++) {
    json_open(j, side ? "high" : "low", '[');
    for (int k = 0; k < 3; k++) json_float(j, NULL, (side ? r->high : r->low)[k]);
    json_close(j, ']');
  }
  json_count(j, "components", r->components);
  json_count(j, "closed", r->closed);
  json_count(j, "turned_inwards", r->inwards);
  json_float(j, "area", r->area);
  json_float(j, "volume", r->volume);
  json_faults(j, t);
}

// Prints the facts of one file, a mesh or a body. Returns 0 after a complaint.
static int info_of(const char *path, float scale, const settings *options) {
  const nsvcd_encode_options defaults = {.open = options->encode.open};
  json_out j = {stdout, 0};
  thing t;
  int good = open_thing(path, &t);
  if (good && t.is_body && options->scale)
    good = complain("--scale is for meshes; %s is a body, in metres", t.path);
  t.recentre = options->recentre && !t.is_body;
  if (good) good = t.is_body ? take_body(&t, 1) : take_mesh(&t, scale);
  const int is_mesh = good && !t.is_body;
  if (is_mesh) good = encode_thing(&t, &defaults);
  if (is_mesh && !options->json) print_mesh(&t);
  if (good && options->json) {
    json_open(&j, NULL, '{');
    json_text(&j, "path", t.path);
    if (!t.is_body) json_mesh(&j, &t);
    json_facts(&j, t.body);
    json_end_line(&j);
  } else if (!t.is_body && t.format) {
    for (int i = 0; i < t.fault_count; i++) printf("wrong: %s\n", t.faults[i]);
    if (good && !t.fault_count) printf("nothing is wrong with it\n");
  }
  if (good && !options->json) print_facts(t.is_body ? t.path : "as a body", t.body);
  free_thing(&t);
  return good;
}

static int info(settings *options) {
  float scales[2];
  int good = 1;
  if (options->path_count == 0)
    return usage_error("info", "expected a mesh or a .body file ('svcd info --help')");
  if (!take_scales(options->scale, 1, scales)) return USAGE;
  for (size_t i = 0; i < options->path_count; i++) {
    if (i && !options->json) printf("\n");
    good &= info_of(options->paths[i], scales[0], options);
  }
  return good ? DONE : REFUSED;
}

#endif
