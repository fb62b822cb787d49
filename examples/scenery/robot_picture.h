// robot_picture.h - a motion of a robot as a picture or a film (SVG, draw.h): the obstacles, the robot
// at the start, on its way and at the end. Include robot_file.h and sweep_picture.h first.
#ifndef NSVCD_SCENERY_ROBOT_PICTURE_H
#define NSVCD_SCENERY_ROBOT_PICTURE_H

#define ROBOT_WIDTH 912
#define ROBOT_HEIGHT 640
#define ROBOT_EDGE 24
#define ROBOT_BESIDE 0.2  // metres about the robot that are shown
#define ROBOT_GROUND 1.0  // metres: obstacles of this radius lie below all others
#define ROBOT_GHOSTS 5    // robots drawn between the start and the end
#define ROBOT_FRAMES 40   // frames of a film
#define ROBOT_LOOKS 200   // points of the way that is drawn as a line

typedef struct robot_picture {
  const robot_in_room *in;
  oracle_mesh *meshes;  // the file's meshes
  draw_view view;
} robot_picture;

static int robot_picture_open(robot_picture *p, const robot_in_room *in) {
  const robot_file *file = in->file;
  int good = 1;
  p->in = in;
  p->meshes = (oracle_mesh *)allocate(file->mesh_count * sizeof *p->meshes);
  memset(p->meshes, 0, file->mesh_count * sizeof *p->meshes);
  for (size_t i = 0; i < file->mesh_count && good; i++) {
    nsvcd_mesh mesh;
    if (!file->meshes[i].is_needed) continue;
    if (!load_shape(file->path, &file->meshes[i].shape, &mesh)) return 0;
    double *points = (double *)allocate(3 * mesh.vertex_count * sizeof *points);
    for (size_t n = 0; n < 3 * mesh.vertex_count; n++) points[n] = (double)mesh.positions[n];
    good = oracle_mesh_init(&p->meshes[i], points, mesh.vertex_count, mesh.indices,
                            mesh.triangle_count, 1);
    free(points);
    nsvcd_mesh_free(&mesh, NULL);
  }
  return good ? 1 : complain("%s: not enough memory", file->path);
}

static void robot_picture_close(robot_picture *p) {
  for (size_t i = 0; i < p->in->file->mesh_count; i++) oracle_mesh_free(&p->meshes[i]);
  free(p->meshes);
}

static const oracle_mesh *robot_picture_mesh(const robot_picture *p, size_t part) {
  const robot_file *file = p->in->file;
  const size_t bodies = file->body_count;
  const size_t thing = part < bodies ? part : p->in->room->first + part - bodies;
  return &p->meshes[file->things[thing].mesh];
}

// Parts in [first, end) at joints.
static void robot_picture_add(const robot_picture *p, draw_list *list, const double *joints,
                              size_t first, size_t end, const draw_colour *colour, double opacity) {
  nsvcd_pose *poses = (nsvcd_pose *)allocate(p->in->scene.part_count * sizeof *poses);
  nsvcd_forward_kinematics(p->in->checker, joints, poses);
  for (size_t n = first; n < end; n++) {
    const oracle_pose pose = pose_widened(&poses[n]);
    draw_solid(list, robot_picture_mesh(p, n), &pose, colour, opacity);
  }
  free(poses);
}

// The robot's places and what is beside them fit into the panel, seen from where there are no
// obstacles.
static void robot_picture_fit(robot_picture *p, const nsvcd_joint_motion *m) {
  const size_t parts = p->in->scene.part_count;
  const size_t bodies = p->in->file->body_count;
  nsvcd_pose *poses = (nsvcd_pose *)allocate(parts * sizeof *poses);
  double middles[2][3] = {{0, 0, 0}, {0, 0, 0}};   // the obstacles' middle, and the robot's places'
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};  // a box of both
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  sweep_frame frame = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (int pass = 0; pass < 2; pass++) {
    for (size_t look = 0; look <= 16; look++) {
      double joints[NSVCD_MAX_JOINTS];
      const double end = m->pieces ? m->times[m->pieces] : 0;
      nsvcd_motion_at(m, p->in->scene.joint_count, end * (double)look / 16, joints);
      nsvcd_forward_kinematics(p->in->checker, joints, poses);
      for (size_t n = 0; n < 8 * parts; n++) {
        const oracle_mesh *mesh = robot_picture_mesh(p, n / 8);
        const oracle_pose pose = pose_widened(&poses[n / 8]);
        double corner[3], world[3];
        sweep_corner(mesh->low, mesh->high, (int)(n % 8), corner);
        oracle_transform(&pose, corner, world);
        const int is_body = n / 8 < bodies;
        for (int k = 0; k < 3; k++) {
          const size_t of = is_body ? bodies : parts - bodies;
          middles[is_body][k] += world[k] / (double)(8 * 17 * of);
          if (pass) world[k] = fmax(low[k] - ROBOT_BESIDE, fmin(high[k] + ROBOT_BESIDE, world[k]));
          if (!pass && is_body) low[k] = fmin(low[k], world[k]);
          if (!pass && is_body) high[k] = fmax(high[k], world[k]);
        }
        if (pass) sweep_widen(&frame, &p->view, world);
      }
    }
    if (pass) continue;
    memset(&p->view, 0, sizeof p->view);
    p->view.scale = 1;
    p->view.elevation = 0.42;
    // the view goes from the obstacles to the robot, and a little aside
    p->view.azimuth = atan2(middles[1][1] - middles[0][1], middles[1][0] - middles[0][0]) + 0.65;
  }
  sweep_fit_frame(&frame, ROBOT_WIDTH, ROBOT_HEIGHT, ROBOT_EDGE, &p->view);
  free(poses);
}

// Draws the way of the last body's middle.
static void robot_picture_way(FILE *svg, const robot_picture *p, const nsvcd_joint_motion *m) {
  const size_t last = p->in->file->body_count - 1;
  const double end = m->pieces ? m->times[m->pieces] : 0;
  nsvcd_pose *poses = (nsvcd_pose *)allocate(p->in->scene.part_count * sizeof *poses);
  fprintf(svg, "<path fill=\"none\" stroke=\"" DRAW_INK
               "\" stroke-width=\"2\" stroke-dasharray=\"2 6\" stroke-linecap=\"round\" d=\"");
  for (int look = 0; look <= ROBOT_LOOKS; look++) {
    double joints[NSVCD_MAX_JOINTS], world[3];
    nsvcd_motion_at(m, p->in->scene.joint_count, end * look / ROBOT_LOOKS, joints);
    nsvcd_forward_kinematics(p->in->checker, joints, poses);
    const oracle_pose pose = pose_widened(&poses[last]);
    oracle_transform(&pose, robot_picture_mesh(p, last)->center, world);
    draw_to(svg, &p->view, look == 0, world);
  }
  fprintf(svg, "\"/>\n");
  free(poses);
}

// The robot at a time of the motion among the obstacles; in a picture ghosts of the way it came.
static void robot_picture_scene(FILE *svg, const robot_picture *p, const nsvcd_joint_motion *m,
                                double time, int ghosts) {
  const size_t parts = p->in->scene.part_count;
  const size_t bodies = p->in->file->body_count;
  draw_list list = {&p->view, NULL, 0, 0, 0};
  double joints[NSVCD_MAX_JOINTS];
  // what is larger than the rest is the ground
  for (size_t n = bodies; n < parts; n++) {
    if (robot_picture_mesh(p, n)->radius < ROBOT_GROUND) continue;
    robot_picture_add(p, &list, m->points, n, n + 1, &draw_steel, 1);
  }
  draw_flush(svg, &list);
  for (int ghost = 0; ghost <= ghosts; ghost++) {
    const int is_last = ghost == ghosts;
    const int is_start = ghost == 0 && !is_last;
    nsvcd_motion_at(m, p->in->scene.joint_count, ghosts ? time * ghost / ghosts : time, joints);
    for (size_t n = bodies; n < parts && is_last; n++) {
      if (robot_picture_mesh(p, n)->radius < ROBOT_GROUND)
        robot_picture_add(p, &list, joints, n, n + 1, &draw_wood, 1);
    }
    robot_picture_add(p, &list, joints, 0, bodies, is_start ? &draw_orange : &draw_blue,
                      is_last    ? 1
                      : is_start ? 0.7
                                 : 0.25);
  }
  draw_flush(svg, &list);
}

// Draws a picture, or a film that lasts as long as the motion and a second. Returns 0 after a
// complaint.
static int robot_draw(const char *path, int is_film, const robot_in_room *in, const char *id,
                      const nsvcd_joint_motion *m) {
  robot_picture p;
  char title[SWEEP_NAME], line[160];
  const double end = m->pieces ? m->times[m->pieces] : 0;
  int good = robot_picture_open(&p, in);
  snprintf(line, sizeof line, "%.2f s, proven free at all times; %s", end,
           is_film ? "again and again" : "orange: the start");
  FILE *svg = good ? draw_open(path, ROBOT_WIDTH + 2 * ROBOT_EDGE, ROBOT_HEIGHT + 110,
                               sweep_escape(id, title, sizeof title), line)
                   : NULL;
  if (svg) {
    robot_picture_fit(&p, m);
    draw_panel(svg, ROBOT_EDGE, 84, &p.view);
    if (!is_film) robot_picture_scene(svg, &p, m, end, ROBOT_GHOSTS + 1);
    const int frames = is_film ? ROBOT_FRAMES : 0;
    for (int k = 0; k < frames; k++) {
      const double time = (end + 1) * k / frames;
      draw_frame(svg, k, frames, end + 1);
      robot_picture_scene(svg, &p, m, time < end ? time : end, 0);
      draw_frame_end(svg);
    }
    robot_picture_way(svg, &p, m);
    draw_panel_end(svg, &p.view, "");
    good = draw_close(svg);
  }
  robot_picture_close(&p);
  return good && svg;
}
#endif  // NSVCD_SCENERY_ROBOT_PICTURE_H
