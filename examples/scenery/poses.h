// poses.h - poses between the library's float and the oracle's double. After neuralsvcd.h and
// oracle.h.
#ifndef NSVCD_SCENERY_POSES_H
#define NSVCD_SCENERY_POSES_H

// volatile: where gcc 12.2 vectorizes (double)(float)x it drops both conversions.
static inline float pose_to_float(double x) {
  volatile float rounded = (float)x;
  return rounded;
}
static inline nsvcd_pose pose_rounded(const oracle_pose *pose) {
  nsvcd_pose out;
  for (int k = 0; k < 3; k++) out.position[k] = pose_to_float(pose->position[k]);
  for (int k = 0; k < 4; k++) out.rotation[k] = pose_to_float(pose->rotation[k]);
  return out;
}
// The rotation is normalized, as the library's reader of it does.
static inline oracle_pose pose_widened(const nsvcd_pose *pose) {
  oracle_pose out;
  for (int k = 0; k < 3; k++) out.position[k] = (double)pose->position[k];
  for (int k = 0; k < 4; k++) out.rotation[k] = (double)pose->rotation[k];
  oracle_quat_normalize(out.rotation);
  return out;
}

#endif
