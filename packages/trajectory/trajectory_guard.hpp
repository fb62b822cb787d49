// SPDX-License-Identifier: MIT
// trajectory_guard.hpp - trajectory_guard.h for C++11: a guard that closes itself, and trajectories of vectors
// as ROS has them (trajectory_msgs::msg::JointTrajectory), in any order of joints.
#ifndef TRAJECTORY_GUARD_HPP
#define TRAJECTORY_GUARD_HPP
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "trajectory_guard.h"

class TrajectoryGuard {
 public:
  // As guard_open; scene "": no obstacles. Throws std::runtime_error, which says why, where that is NULL.
  TrajectoryGuard(const std::string &planning_file, const std::string &scene, float clearance,
                  std::size_t most_points)
      : guard_(nullptr, guard_close) {
    char reason[1024] = "";
    guard_.reset(guard_open(planning_file.c_str(), scene.empty() ? nullptr : scene.c_str(),
                            clearance, most_points, reason, sizeof reason));
    if (!guard_) throw std::runtime_error(reason);
    const std::size_t all = most_points * joints();
    for (std::vector<double> *values : {&positions_, &velocities_, &accelerations_})
      values->resize(all);
    times_.resize(most_points);
  }
  std::size_t joints() const {
    return guard_joints(guard_.get());
  }
  std::string joint_name(std::size_t joint) const {
    return guard_joint_name(guard_.get(), joint);
  }

  // The place of each joint of a message in the guard's order. Throws std::invalid_argument if a joint of
  // the guard is missing. Joints that it does not know are left out. Allocates.
  std::vector<std::size_t> order_of(const std::vector<std::string> &names) const {
    std::vector<std::size_t> order;
    for (std::size_t joint = 0; joint < joints(); joint++) {
      std::size_t at = 0;
      while (at < names.size() && names[at] != joint_name(joint)) at++;
      if (at == names.size()) throw std::invalid_argument("no joint " + joint_name(joint));
      order.push_back(at);
    }
    return order;
  }

  // Point: has vectors positions, velocities and accelerations, the latter two perhaps empty, in all points
  // alike, as trajectory_msgs::msg::JointTrajectoryPoint. seconds_of(point): its time_from_start.
  // Allocates nothing, throws nothing. REFUSED is a point whose vectors are too short, and a first point that
  // lies after both 0 and `from`: a controller comes there from where the robot is, which is to be a
  // point before it.
  template <class Points, class SecondsOf>
  guard_answer check(const Points &points, const std::vector<std::size_t> &order,
                     SecondsOf seconds_of, double from, double to, double seconds) {
    guard_trajectory t = guard_trajectory();
    t.count = points.size();
    if (t.count < 1 || t.count > times_.size()) return refused("no points, or too many");
    if (order.size() != joints()) return refused("no order of this guard's joints");
    const std::size_t joints_of_all = order.size();
    const bool has_speed = !points.begin()->velocities.empty();
    const bool has_both = !points.begin()->accelerations.empty();
    if (has_both && !has_speed) return refused("accelerations without velocities");
    std::size_t at = 0;
    for (const auto &point : points) {
      times_[at / joints_of_all] = seconds_of(point);
      if (point.velocities.empty() == has_speed || point.accelerations.empty() == has_both)
        return refused("some points have velocities or accelerations, others have none");
      for (const std::size_t joint : order) {
        if (joint >= point.positions.size() || (has_speed && joint >= point.velocities.size()) ||
            (has_both && joint >= point.accelerations.size()))
          return refused("a point has too few numbers");
        positions_[at] = point.positions[joint];
        if (has_speed) velocities_[at] = point.velocities[joint];
        if (has_both) accelerations_[at] = point.accelerations[joint];
        at++;
      }
    }
    if (times_[0] > 0 && from < times_[0])
      return refused("the way to its first point is not known: begin with where the robot is");
    t.positions = positions_.data();
    t.velocities = has_speed ? velocities_.data() : nullptr;
    t.accelerations = has_both ? accelerations_.data() : nullptr;
    t.times = times_.data();
    return guard_check(guard_.get(), &t, from, to, seconds);
  }

  bool move(const char *obstacle, const float pose[7]) {
    return guard_move(guard_.get(), obstacle, pose) != 0;
  }

 private:
  static guard_answer refused(const char *reason) {
    guard_answer out = guard_answer();
    out.verdict = GUARD_REFUSED;
    out.reason = reason;
    return out;
  }
  std::unique_ptr<trajectory_guard, void (*)(trajectory_guard *)> guard_;
  std::vector<double> positions_, velocities_, accelerations_, times_;
};
#endif  // TRAJECTORY_GUARD_HPP
