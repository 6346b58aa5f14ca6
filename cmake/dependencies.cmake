# Every library that the core stands on; the Debian packages are listed in packages.txt.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(octomap 1.9 REQUIRED CONFIG)
find_package(hwy 1.0 REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(yaml-cpp REQUIRED CONFIG)
