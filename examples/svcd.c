// SPDX-License-Identifier: MIT
// svcd.c - neuralsvcd.h on the command line: does this body, moving along this trajectory, hit that
// one? What is wrong with a mesh? Encodes meshes, answers files of problems, plans robot motions.
//
// `svcd --help` says how to use it, FORMATS.md what it reads and prints. Exit status: 0 done, 1 a
// file or a line was refused (file, line and reason on standard error), 2 usage. With sweep
// --exit-code: 0 free, 1 hit, 3 undecided, 2 anything else.
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_certify.h"
#include "../extras/neuralsvcd_robot.h"
#define PROGRAM "svcd"
#include "svcd/check.h"
#include "svcd/bodies.h"
#include "svcd/robots.h"
#include "svcd/sweep.h"

// ---------------------------------------------------------------------------------------- settings

enum { CHECK = 1, ENCODE = 2, INFO = 4, SWEEP = 8, PLAN = 16, PATH = 32, PAIRS = 64 };
#define ALL (CHECK | ENCODE | INFO | SWEEP | PLAN | PATH | PAIRS)

#define AT(member) offsetof(settings, member)
#define POINTS NSVCD_MAX_PATCHES
#define METRES (double)NSVCD_MAX_COORDINATE
#define TEXT_OF(number) #number
#define DIGITS(macro) TEXT_OF(macro)
static const option options[] = {
    {"--from", SWEEP, OPTION_TEXT, AT(from), 0, 0, NULL, "POSE",
     "x,y,z[,qx,qy,qz,qw]: the pose of A at t = 0, in metres, whatever --scale says (as its file "
     "has "
     "it)"},
    {"--to", SWEEP, OPTION_TEXT, AT(to), 0, 0, NULL, "POSE", "the same at t = 1"},
    {"--rotate", SWEEP, OPTION_TEXT, AT(rotate), 0, 0, NULL, "AXIS,DEG",
     "A turns by this on its way, about its origin: z,90"},
    {"--poses", SWEEP, OPTION_TEXT, AT(poses), 0, 0, NULL, "TABLE",
     "the poses of A, a line each: [t] x y z [qx qy qz qw], between blanks or commas, in metres, "
     "whatever --scale says; instead of --from, --to and --rotate"},
    {"--all", SWEEP, OPTION_FLAG, AT(all), 0, 0, NULL, NULL,
     "with --poses: lists all lines of the table between which there is a contact, and the first "
     "contact there"},
    {"--scale", ENCODE | INFO | SWEEP, OPTION_TEXT, AT(scale), 0, 0, NULL, "S[,S]",
     "converts files to metres: 0.001 for millimetres; with two files, one for both or one for "
     "each "
     "(1)"},
    {"--recentre", ENCODE | INFO | SWEEP, OPTION_FLAG, AT(recentre), 0, 0, NULL, NULL,
     "subtracts the centre of each mesh's box, in whole units of its file, from its coordinates, "
     "as a map needs it; poses mean what they do without, but A turns about its centre"},
    {"--picture", SWEEP, OPTION_TEXT, AT(picture), 0, 0, NULL, "OUT.svg",
     "draws B, and A at the start, at the contact and at the end"},
    {"--picture", PLAN, OPTION_TEXT, AT(picture), 0, 0, NULL, "OUT.svg",
     "draws the motion of the one plan that --only names"},
    {"--film", PLAN, OPTION_TEXT, AT(film), 0, 0, NULL, "OUT.svg", "the same, moving"},
    {"--certificate", SWEEP, OPTION_TEXT, AT(certificate), 0, 0, NULL, "OUT.cert",
     "writes a proof of the answer, and what it is about to OUT.txt; svcd-verify OUT.txt FOLDER "
     "checks it"},
    {"--certificates", CHECK | PLAN, OPTION_TEXT, AT(certificates), 0, 0, NULL, "FOLDER",
     "writes a proof of each answer, ID.cert, into an existing folder; svcd-verify FILE FOLDER "
     "checks them"},
    {"--certificates", PAIRS, OPTION_TEXT, AT(certificates), 0, 0, NULL, "FOLDER",
     "writes a proof of each two bodies that never meet, A-B.cert, into an existing folder; "
     "svcd-verify --pairs FILE FOLDER checks them"},
    {"--visits", CHECK | SWEEP | PLAN | PAIRS, OPTION_COUNT, AT(visits), 1, 1000000000, NULL, "N",
     "steps that a certificate may take; for plan, that of a pair (" DIGITS(
         NSVCD_DEFAULT_VISITS) ")"},
    {"--clearance", CHECK | SWEEP | PLAN | PATH, OPTION_NUMBER, AT(sweep.clearance), 0, METRES,
     "NSVCD_MAX_COORDINATE", "METRES",
     "coming within this distance is a hit (0: only meeting is); for plan and path, of obstacles"},
    {"--measure", SWEEP, OPTION_NUMBER, AT(measure), 1e-9, METRES, "NSVCD_MAX_COORDINATE", "METRES",
     "if they are free: how near do they come? to this precision"},
    {"--skin", CHECK | SWEEP, OPTION_NUMBER, AT(sweep.slop), 0, METRES, "NSVCD_MAX_COORDINATE",
     "METRES", "contact at the start up to this depth is no hit (0)"},
    {"--first", CHECK, OPTION_LENGTH, AT(first), 0, 1, "or metres: 0.001m", "T|METRESm",
     "finds the first contact, to this fraction of the motion, or to metres: 0.001m (0: any "
     "contact)"},
    {"--first", SWEEP, OPTION_LENGTH, AT(first), 0, 1, "or metres: 0.001m", "T|METRESm",
     "finds the first contact, to this fraction of the motion, or to metres: 0.001m (0.001; with "
     "--poses 1e-6; 0: any contact)"},
    {"--first", PATH, OPTION_NUMBER, AT(first_to), 1e-9, 1e6, NULL, "S",
     "finds the first hit of a curve, or of motions together, to so many seconds (curves: any hit; "
     "together: 0.001)"},
    {"--method", CHECK | SWEEP, OPTION_WORD, AT(sweep.method), NSVCD_METHOD_PROOF, 0,
     "proof|network", NULL, "a witness or a certificate; or an opinion (proof)"},
    {"--points", CHECK | ENCODE | SWEEP, OPTION_COUNT, AT(encode.patches), 1, POINTS,
     "NSVCD_MAX_PATCHES", "N",
     "patches of a body, up to " DIGITS(NSVCD_MAX_PATCHES) " (" DIGITS(
         NSVCD_LEAST_PATCHES) " and more, by the number of triangles; " DIGITS(NSVCD_DEFAULT_NETWORK_PATCHES) " for the network)"},
    {"--radius", ENCODE, OPTION_NUMBER, AT(encode.patch_radius), 1e-12, METRES,
     "NSVCD_MAX_COORDINATE", "METRES", "as many patches as give each about this radius"},
    {"--latents", ENCODE, OPTION_FLAG, AT(encode.latents), 0, 0, NULL, NULL,
     "for the network as well as for the proof"},
    {"--no-triangles", ENCODE, OPTION_FLAG, AT(encode.no_triangles), 0, 0, NULL, NULL,
     "for the network alone"},
    {"--open", ALL, OPTION_FLAG, AT(encode.open), 0, 0, NULL, NULL,
     "a mesh that is not closed is a sheet: nothing is inside of it"},
    {"--pairs", CHECK, OPTION_COUNT, AT(sweep.network.pairs), 1, NSVCD_MAX_PAIRS, "NSVCD_MAX_PAIRS",
     "K", "pairs of patches that the network decodes, up to " DIGITS(NSVCD_MAX_PAIRS) " (8)"},
    {"--model", CHECK, OPTION_WORD, AT(sweep.network.model), NSVCD_MODEL_TINY, 0, "tiny|small|base",
     NULL, "the network's decoder (base)"},
    {"--int8", CHECK, OPTION_FLAG, AT(int8), 0, 0, NULL, NULL, "run it in 8-bit integers"},
    {"--recall", CHECK, OPTION_NUMBER, AT(sweep.network.recall), 0, 1, NULL, "R",
     "fraction of collisions to find: 0.99, 0.999, 0.9999; 0: balanced errors (0)"},
    {"--work", SWEEP | PATH, OPTION_COUNT, AT(sweep.work), 1, 1000000000, NULL, "N",
     "units that a proof may take; for path, that of a pair (as many as there is time for)"},
    {"--work", CHECK, OPTION_COUNT, AT(sweep.work), 1, 1000000000, NULL, "N",
     "units that a proof may take (" DIGITS(NSVCD_DEFAULT_VERDICT_WORK) ")"},
    {"--repeat", CHECK | SWEEP, OPTION_COUNT, AT(repeat), 1, 1000000, NULL, "R",
     "timed runs of a query: check reports the shortest (5), sweep the median (101, or as many as "
     "fit into a second)"},
    {"--details", CHECK, OPTION_TEXT, AT(details), 0, 0, NULL, "OUT.tsv",
     "writes all that is known, one line per problem: brackets of time and distance, depth, where "
     "it is safe to go, contacts"},
    {"--only", PLAN | PATH, OPTION_TEXT, AT(only), 0, 0, NULL, "ID,ID", "only these"},
    {"--seed", PLAN | PAIRS, OPTION_COUNT, AT(seed), 0, 1000000000, NULL, "S",
     "of the random numbers (0)"},
    {"--threads", PLAN, OPTION_COUNT, AT(threads), 1, 256, NULL, "N",
     "N seeds at once, from --seed on, a thread for each: the motion that takes the least time "
     "(1)"},
    {"--seconds", SWEEP | PATH, OPTION_NUMBER, AT(seconds), 1e-3, 1e9, NULL, "S",
     "asks again, with more work, what is undecided for want of work, for up to S seconds (10)"},
    {"--seconds", PLAN, OPTION_NUMBER, AT(seconds), 1e-3, 1e9, NULL, "S",
     "ends each plan within S seconds, with the best motion proven by then, or with 'limit'"},
    {"--seconds", PAIRS, OPTION_NUMBER, AT(seconds), 1e-3, 1e9, NULL, "S",
     "ends within S seconds, whatever is unknown by then (10)"},
    {"--srdf", PAIRS, OPTION_TEXT, AT(srdf), 0, 0, NULL, "OUT.srdf",
     "writes which links need not be checked, as it is proven of all their bodies"},
    {"--samples", PLAN, OPTION_COUNT, AT(samples), 2, 10000000, NULL, "N",
     "with --joints: the number of times at which the joints are written"},
    {"--joints", PLAN, OPTION_TEXT, AT(joints), 0, 0, NULL, "OUT.tsv",
     "with --samples: writes the joints, one line per time: ID K JOINTS"},
    {"--exit-code", SWEEP, OPTION_FLAG, AT(exit_code), 0, 0, NULL, NULL,
     "the exit status is the answer: 0 free, 1 hit, 3 undecided; 2 if there is none"},
    {"--json", ALL, OPTION_FLAG, AT(json), 0, 0, NULL, NULL, "one line of JSON per answer"},
    {"--help", ALL, OPTION_FLAG, AT(help), 0, 0, NULL, NULL, "this text"},
    {"-h", ALL, OPTION_FLAG, AT(help), 0, 0, NULL, NULL, NULL},
};

static const command commands[] = {
    {"sweep", SWEEP, sweep, 2, "A B ", "A moves, B rests: do they hit, when and where?",
     "A moves, B rests where its file has it: do they hit each other? Both are meshes (OBJ, STL, "
     "PLY, GLB) or .body files; - is standard input. Without --from and --to, A passes straight "
     "through the middle of B's box, from outside to outside, downwards along the axis along which "
     "B is thinnest. The first line begins with hit, free or undecided; the exit status is 0 for "
     "each of them, unless --exit-code is given."},
    {"info", INFO, info, (size_t)-1, "FILE... ", "what a mesh is, and what is wrong with it",
     "For a mesh: triangles, box, components, area and volume, the body that it makes, and its "
     "faults: an unlikely size, inside out, open edges, inconsistent winding, non-manifold edges, "
     "triangles without area or too large for the patches. For a body: patches, bytes, triangles, "
     "sphere."},
    {"encode", ENCODE, encode, 2, "IN OUT.body|OUT.h ", "a body, ready to be loaded, or a C array",
     "Encodes a mesh, to a file or to a C array."},
    {"check", CHECK, check, 1, "PROBLEMS ", "answers a file of problems",
     "Answers the problems of a file, one line each on standard output, separated by tabs: ID "
     "LOGIT COLLIDES TIME MOVING_PATCH FIXED_PATCH STATUS MICROSECONDS. A summary goes to standard "
     "error."},
    {"plan", PLAN, plan, 1, "ROBOT ", "motions of a robot, found and proven",
     "Finds a motion for each plan of a planning file, and proves it. One line each, separated by "
     "tabs: ID certified|start|goal|limit|undecided SECONDS DURATION LENGTH. The motion keeps the "
     "clearance from obstacles. The exit status is 1 if a certificate could not "
     "be written."},
    {"path", PATH, path, 1, "ROBOT ", "are paths of robots free, between their points too?",
     "Is each path, curve or 'together' of a planning file free, between its points too? One line "
     "each, separated by tabs: ID free|hit|undecided EDGE T NAME NAME MICROSECONDS: the first edge "
     "that is not free, when, and which two bodies; the mean time of an edge. Of motions together, "
     "each on a clock of its own, EDGE is 0 and T is the time of the first conflict, seconds."},
    {"pairs", PAIRS, pairs, 1, "ROBOT ", "which bodies of a robot can meet each other?",
     "Which bodies of a planning file's robot can meet each other? Prints a line 'pair NAME NAME' "
     "for each two that do sometimes, with a configuration of each kind, or of which it is not "
     "known. Those that never or always meet, whatever the joints do within their limits, are "
     "comments: that is proven, of neighbours too. --srdf writes the same of links, for MoveIt and "
     "others."},
};
static const manual svcd = {
    "svcd",
    NSVCD_VERSION,
    "does a body, moving along a trajectory, hit another one? (neuralsvcd.h)",
    "'svcd COMMAND --help' lists a command's options, 'svcd --version' prints the version, "
    "'svcd --manual man' prints a man page, and 'svcd --manual bash', zsh or fish completions. "
    "A file may be -, standard input. Exit status: 0 done, 1 a file or a line was refused, 2 "
    "usage; for 'svcd sweep --exit-code' the answer. What it reads and prints: FORMATS.md, in "
    "examples or share/doc/neuralsvcd. 'svcd-verify' (build/verify) checks its certificates; 'cc "
    "-O2 "
    "examples/verify/verify.c -lm -o verify' makes it without make.",
    commands,
    sizeof commands / sizeof commands[0],
    options,
    sizeof options / sizeof options[0],
    "svcd-verify",
    "[--pairs] FILE.txt FOLDER [--clearance METRES] [--only ID,ID] [--claims]",
    "Checks certificates without the library: FILE.txt is a problem file or a planning file, "
    "FOLDER holds ID.cert for each of its problems or plans. Prints one line each, separated by "
    "tabs: ID accepted|refused REASON BYTES MICROSECONDS. --clearance: that of svcd; --only: only "
    "these. --pairs: A-B.cert, that two bodies of a robot never meet. --claims: and a SHA-256 of "
    "what "
    "is proven of. Exit status: 0 each proves what its line says, which may be a hit; 1 one is "
    "refused or missing; 2 a file cannot be read, or usage. In the repository it is build/verify."};

// -------------------------------------------------------------------------------------------- main

static const command *find_command(const char *name) {
  for (size_t i = 0; i < svcd.command_count; i++)
    if (strcmp(name, commands[i].name) == 0) return &commands[i];
  return NULL;
}

static int no_command(const char *name) {
  const char *meant = NULL;
  size_t distance = 3;
  for (size_t i = 0; i < svcd.command_count; i++)
    consider(name, commands[i].name, &meant, &distance);
  char ending[8];
  mesh_ending(name, ending);
  static const char *const files[] = {"obj", "stl", "ply", "glb", "body"};
  for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
    if (strcmp(ending, files[i]) == 0) meant = "sweep A B";
  if (meant)
    complain("no command '%s'; did you mean 'svcd %s'?", name, meant);
  else
    complain(
        "no command '%s': there are sweep, info, encode, check, plan, path and pairs ('svcd "
        "--help')",
        name);
  return USAGE;
}

// Has everything printed been written?
static int is_written(void) {
  return fflush(stdout) == 0 && !ferror(stdout);
}

static int run(const command *c, int argc, char **argv) {
  const command_line line = {options, svcd.option_count, c->bit, c->name, argv, argc};
  settings given;
  memset(&given, 0, sizeof given);
  given.first[0] = -1;
  given.paths = (const char **)allocate((size_t)(argc + 1) * sizeof *given.paths);
  int status = take_options(&line, &given, given.paths, c->paths, &given.path_count);
  given.is_first_given = given.first[0] >= 0;
  if (!given.is_first_given) given.first[0] = 0;
  if (!given.repeat) given.repeat = c->bit == SWEEP ? 101 : 5;
  if (status == DONE && given.help) manual_help(stdout, &svcd, c);
  if (given.exit_code) status_of_failure = USAGE;
  if (status == DONE && !given.help) {
    status = c->run(&given);
    if (given.exit_code) status = status == DONE && is_written() ? given.answer : USAGE;
  }
  free(given.paths);
  return status;
}

static int serve(int argc, char **argv) {
  const char *name = argc > 1 ? argv[1] : "";
  const int help =
      strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0;
  if (argc < 2) {
    manual_overview(stderr, &svcd);
    return USAGE;
  }
  if (strcmp(name, "--version") == 0) return printf("svcd %s\n", NSVCD_VERSION), DONE;
  if (strcmp(name, "--manual") == 0) {
    if (argc == 3 && manual_print(stdout, &svcd, argv[2])) return DONE;
    return usage_error("--manual", "man, bash, zsh or fish");
  }
  if (help && argc > 2) name = argv[2];
  const command *c = find_command(name);
  if (help) {
    if (argc > 2 && !c) return no_command(name);
    if (c)
      manual_help(stdout, &svcd, c);
    else
      manual_overview(stdout, &svcd);
    return DONE;
  }
  return c ? run(c, argc - 2, argv + 2) : no_command(name);
}

int main(int argc, char **argv) {
  take_arguments(&argc, &argv);
  const int status = serve(argc, argv);
  if (is_written()) return status;
  complain("standard output cannot be written");
  return status == DONE ? REFUSED : status;
}
