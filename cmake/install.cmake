# cmake --install, and find_package(roam) with the target roam::roam.
