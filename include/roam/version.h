#pragma once
/// \file
/// The version of these headers, for programs that serve several: https://semver.org. Before 1.0 a new minor version
/// may change the interface. `find_package(roam 0.1)` requires one when a program is configured.
///
///     #if ROAM_VERSION >= ROAM_VERSION_NUMBER(0, 2, 0)

#define ROAM_VERSION_MAJOR 0
#define ROAM_VERSION_MINOR 1
#define ROAM_VERSION_PATCH 0
#define ROAM_VERSION_STRING "0.1.0"

/// A version as one number that grows with it. Minor and patch are below 1000.
#define ROAM_VERSION_NUMBER(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))
#define ROAM_VERSION ROAM_VERSION_NUMBER(ROAM_VERSION_MAJOR, ROAM_VERSION_MINOR, ROAM_VERSION_PATCH)
