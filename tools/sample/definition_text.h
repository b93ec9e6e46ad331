#pragma once

// Pieces of ROS 2 definitions that several types end with, as literals that are joined with what stands before them.
// The separator is eighty '=' as rosbag2 writes it.
#define STILLFRAME_SEPARATOR "================================================================================\n"
#define STILLFRAME_HEADER                  \
  STILLFRAME_SEPARATOR                     \
  "MSG: std_msgs/Header\n"                 \
  "builtin_interfaces/Time stamp\n"        \
  "string frame_id\n" STILLFRAME_SEPARATOR \
  "MSG: builtin_interfaces/Time\n"         \
  "int32 sec\n"                            \
  "uint32 nanosec\n"
#define STILLFRAME_POSE                           \
  STILLFRAME_SEPARATOR                            \
  "MSG: geometry_msgs/Pose\n"                     \
  "Point position\n"                              \
  "Quaternion orientation\n" STILLFRAME_SEPARATOR \
  "MSG: geometry_msgs/Point\n"                    \
  "float64 x\n"                                   \
  "float64 y\n"                                   \
  "float64 z\n" STILLFRAME_SEPARATOR              \
  "MSG: geometry_msgs/Quaternion\n"               \
  "float64 x 0\n"                                 \
  "float64 y 0\n"                                 \
  "float64 z 0\n"                                 \
  "float64 w 1\n"
