// What the programs of the nodes have in common.
#pragma once

#include <ros/init.h>

#include <exception>
#include <iostream>
#include <string>

namespace nbvopt {

/// The main of a node: initialises ROS, runs it, and returns the program's exit code: 3 where
/// `run` throws, which is then told on stderr: ROS may be shut down, with its log.
template <class Run>
int run_node(int argc, char** argv, const std::string& node_name, const Run& run) {
  ros::init(argc, argv, node_name);
  try {
    run();
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 3;
  }
  return 0;
}

}  // namespace nbvopt
