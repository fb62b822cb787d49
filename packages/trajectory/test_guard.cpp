// SPDX-License-Identifier: MIT
// test_guard.cpp - a box on a slide, and another box on its way: what TrajectoryGuard says of straight lines, cubics and
// quintics, against positions computed here by Hermite's formulas. make build/test_guard && build/test_guard FOLDER
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "trajectory_guard.hpp"

static int failures = 0, checks = 0;
#define CHECK(what) \
  (checks++, (what) ? 0 : (failures++, std::printf("test_guard: line %d: %s\n", __LINE__, #what)))

struct Point {
  std::vector<double> positions, velocities, accelerations;
  double seconds;
};
static double seconds_of(const Point &point) {
  return point.seconds;
}

// Where the slide is at a share u of one second from the first point to the second.
static double hermite(const Point &a, const Point &b, double u) {
  const double p0 = a.positions[1], p1 = b.positions[1];
  if (a.velocities.empty()) return p0 + u * (p1 - p0);
  const double v0 = a.velocities[1], v1 = b.velocities[1], u3 = u * u * u, u4 = u3 * u, u5 = u4 * u;
  if (a.accelerations.empty())
    return (2 * u3 - 3 * u * u + 1) * p0 + (u3 - 2 * u * u + u) * v0 + (3 * u * u - 2 * u3) * p1 +
           (u3 - u * u) * v1;
  return (1 - 10 * u3 + 15 * u4 - 6 * u5) * p0 + (u - 6 * u3 + 8 * u4 - 3 * u5) * v0 +
         (u * u - 3 * u3 + 3 * u4 - u5) / 2 * a.accelerations[1] +
         (u3 - 2 * u4 + u5) / 2 * b.accelerations[1] + (-4 * u3 + 7 * u4 - 3 * u5) * v1 +
         (10 * u3 - 15 * u4 + 6 * u5) * p1;
}

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  const std::string path = std::string(argv[1]) + "/slide.txt";
  std::ofstream(path) << "nsvcd-plans 1\n"
                         "joint slide world 0 0 0 0 0 0 1  1 0 0 prismatic -3 3 9\n"
                         "joint spin slide 0 0 0 0 0 0 1  1 0 0 revolute -9 9 9\n"
                         "body box spin box: 0.2 0.2 0.2\n"
                         "scene room\nobstacle wall box: 0.2 1 1  5 0 0 0 0 0 1\n";
  TrajectoryGuard guard(path, "room", 0, 8);
  CHECK(guard.joints() == 2 && guard.joint_name(0) == "slide" && guard.joint_name(1) == "spin");
  const std::vector<std::size_t> order = guard.order_of({"gripper", "slide", "spin"});
  CHECK(order.size() == 2 && order[0] == 1 && order[1] == 2);
  const auto at = [&](double x) {
    const float pose[7] = {static_cast<float>(x), 0, 0, 0, 0, 0, 1};
    return guard.move("wall", pose);
  };
  const auto ask = [&](const std::vector<Point> &points, double from, double to) {
    return guard.check(points, order, seconds_of, from, to, 0);
  };

  // for each kind of curve the wall stands a millimetre before, then behind, the farthest place of the box
  const std::vector<double> none, zero = {0, 0, 0};
  const std::vector<std::vector<Point>> kinds = {
      {{zero, none, none, 2}, {{0, 0.7, 0.5}, none, none, 3}},
      {{zero, {0, 4, 0}, none, 2}, {{0, 0.3, 0.5}, {0, -4, 1}, none, 3}},
      {{zero, {0, 2, 0}, {0, 9, 0}, 2}, {{0, 0.3, 0.5}, {0, -3, 1}, {0, -7, 2}, 3}},
      {{zero, {0, -2, 0}, {0, -4, 0}, 2}, {{0, 0.9, 0.5}, {0, 3, 1}, {0, -30, 2}, 3}}};
  for (const std::vector<Point> &points : kinds) {
    double most = -9, when = 0;
    for (int i = 0; i <= 100000; i++) {
      const double x = hermite(points[0], points[1], i / 1e5);
      if (x > most) most = x, when = i / 1e5;
    }
    CHECK(at(most + 0.2 + 0.001) && ask(points, 2, 9).verdict == GUARD_FREE);
    CHECK(at(most + 0.2 - 0.001) && ask(points, 2, 9).verdict == GUARD_HIT);
    // and in a part of its time: free up to where the box comes to the wall, not beyond
    double touch = 0;
    while (hermite(points[0], points[1], touch) < most - 0.001) touch += 1e-6;
    CHECK(ask(points, 2, 2 + touch - 1e-4).verdict == GUARD_FREE);
    CHECK(ask(points, 2, 2 + touch + 1e-4).verdict == GUARD_HIT);
    CHECK(ask(points, 2 + when, 9).verdict == GUARD_HIT);
    const guard_answer hit = ask(points, 2, 9);
    CHECK(hit.a && hit.b && std::string(hit.a) == "box" && std::string(hit.b) == "wall" &&
          !hit.joint);
    CHECK(hit.free_until <= 2 + touch + 1e-6);
    // the way to its first point is not known, unless that is at 0: before that it rests there
    CHECK(ask(points, 0, 1).verdict == GUARD_REFUSED &&
          ask(points, 1.999, 3).verdict == GUARD_REFUSED);
    std::vector<Point> early = points;
    early[0].seconds = 0, early[1].seconds = 1;
    CHECK(ask(early, -2, -1).verdict == GUARD_FREE && ask(early, -1, 9).verdict == GUARD_HIT);
  }
  // a stop as README asks about it, from 0.6 m/s within a second: 0.3 m, at a constant deceleration
  const std::vector<Point> stop = {{zero, {0, 0.6, 0}, none, 0}, {{0, 0.3, 0}, zero, none, 1}};
  for (double u = 0; u <= 1; u += 0.125)
    CHECK(std::fabs(hermite(stop[0], stop[1], u) - (0.6 * u - 0.3 * u * u)) < 1e-12);
  CHECK(at(0.501) && ask(stop, 0, 1).verdict == GUARD_FREE);
  CHECK(at(0.499) && ask(stop, 0, 1).verdict == GUARD_HIT);
  CHECK(at(5));
  // several points: the pieces join, and a window over a knot is asked whole
  const std::vector<Point> three = {
      {zero, none, none, 0}, {{0, 1, 0}, none, none, 1}, {zero, none, none, 2}};
  CHECK(at(1.199) && ask(three, 0.9, 1.1).verdict == GUARD_HIT &&
        ask(three, 0, 0.99).verdict == GUARD_FREE);
  CHECK(ask(three, 1.01, 2).verdict == GUARD_FREE && at(5) &&
        ask(three, 0, 2).verdict == GUARD_FREE);
  CHECK(ask({{zero, none, none, 0}}, 0, 1).verdict == GUARD_FREE);

  const float slanted[7] = {1.35f, 0,         0,         0,
                            0,     0.258819f, 0.9659258f};  // so near that a box does not tell
  CHECK(guard.move("wall", slanted));
  const guard_answer late = guard.check(three, order, seconds_of, 0, 2, 1e-12);
  CHECK(late.verdict == GUARD_UNDECIDED && std::string(late.reason) == "the time was up");
  CHECK(ask(three, 0, 2).verdict == GUARD_FREE && at(5));
  const guard_answer limit = ask({{zero, none, none, 0}, {{0, 3.1, 0}, none, none, 1}}, 0, 1);
  CHECK(limit.verdict == GUARD_HIT && limit.joint && std::string(limit.joint) == "slide");

  // what is wrong is refused, and changes nothing
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(!at(nan) && ask(three, 0, 2).verdict == GUARD_FREE);
  const float no_pose[7] = {0, 0, 0, 0, 0, 0, 2};
  CHECK(!guard.move("wall", no_pose) && !guard.move("door", no_pose) &&
        ask(three, 0, 2).verdict == GUARD_FREE);
  const std::vector<std::vector<Point>> wrong = {{},
                                                 std::vector<Point>(9, three[0]),
                                                 {three[1], three[0]},
                                                 {three[0], three[0]},
                                                 {{{0}, none, none, 0}},
                                                 {{{0, nan, 0}, none, none, 0}},
                                                 {{zero, {0}, none, 0}, {zero, {0}, none, 1}},
                                                 {{zero, none, none, nan}, three[1]},
                                                 {{zero, none, zero, 0}, {zero, none, zero, 1}},
                                                 {{zero, none, none, 0}, {zero, zero, none, 1}},
                                                 {{zero, zero, none, 0}, {zero, none, none, 1}},
                                                 {{zero, zero, zero, 0}, {zero, zero, none, 1}},
                                                 {{zero, zero, none, 0}, {zero, zero, zero, 1}}};
  for (const std::vector<Point> &points : wrong) {
    const guard_answer answer = ask(points, 0, 2);
    CHECK(answer.verdict == GUARD_REFUSED && answer.reason);
  }
  CHECK(guard.check(three, order, seconds_of, 1, nan, 0).verdict == GUARD_REFUSED);
  CHECK(guard.check(three, {0}, seconds_of, 0, 1, 0).verdict == GUARD_REFUSED);
  // and what cannot be opened says why
  const auto why_not = [](const std::string &file, const char *scene, float clearance,
                          std::size_t most) {
    try {
      TrajectoryGuard none_such(file, scene, clearance, most);
    } catch (const std::runtime_error &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(why_not(path + ".no", "", 0, 8).find(path + ".no: ") == 0);
  CHECK(why_not(path, "hall", 0, 8) == path + ": no scene hall");
  CHECK(why_not(path, "room", -1, 8) == "the clearance is negative, or no number");
  CHECK(why_not(path, "room", 0, 0) == "most_points is 0, or too large");
  std::ofstream(path + ".bad") << "nsvcd-plans 1\nbody box nowhere box: 1 1 1\n";
  CHECK(why_not(path + ".bad", "", 0, 8).find(path + ".bad:2: ") == 0);
  char brief[6];
  CHECK(!guard_open((path + ".no").c_str(), nullptr, 0, 8, brief, sizeof brief) &&
        brief == path.substr(0, 5));
  std::string missing;
  try {
    guard.order_of({"slide"});
  } catch (const std::invalid_argument &error) {
    missing = error.what();
  }
  CHECK(missing == "no joint spin");
  std::printf("test_guard: %d of %d\n", checks - failures, checks);
  return failures != 0;
}
