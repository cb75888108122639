# cmake --build build --target package: Debian packages of what cmake --install installs, in the build folder.
#
#   roam          the program, its manual, completion, entry of the desktop
#   roam-reader   the child process that parses scenes, for the program and all libraries; a package of its own, because
#                 both need it in exactly their version
#   libroam0      libroam.so.0
#   libroam-dev   headers, the libraries of C++, CMake's package, pkg-config
#   python3-roam  import roam
#   roam-doc      the documents and examples
#
# The same build may also be installed below another prefix.
if(NOT CMAKE_LIBRARY_ARCHITECTURE OR NOT EXISTS /etc/debian_version)
  return()
endif()
set(ROAM_MAINTAINER "The roam authors <authors@roam.invalid>" CACHE STRING "Who made the Debian packages")

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME roam)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # it would be the title of every package
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)  # as Debian
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program reader library devel doc)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${ROAM_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian/finish.cmake)
set(roam_debian_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
get_target_property(roam_soversion roam_c SOVERSION)
set(roam_library libroam${roam_soversion})

# roam_debian_package(COMPONENT NAME SECTION TITLE TEXT DEPENDS...)
macro(roam_debian_package component name section title text)
  string(TOUPPER ${component} roam_upper)
  set(roam_depends ${ARGN})
  list(JOIN roam_depends ", " roam_depends)
  set(CPACK_DEBIAN_${roam_upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${roam_upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${roam_upper}_PACKAGE_DEPENDS "${roam_depends}")
  set(CPACK_DEBIAN_${roam_upper}_DESCRIPTION "${title}\n${text}")
  configure_file(cmake/debian/copyright.in debian/${name}/copyright)
  configure_file(cmake/debian/changelog.in debian/${name}/changelog.Debian @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/debian/${name}/copyright ${PROJECT_BINARY_DIR}/debian/${name}/changelog.Debian
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

file(READ LICENSE roam_license)
string(REGEX REPLACE "^MIT License\n\n(Copyright [^\n]*)\n\n" "" roam_license "${roam_license}")
set(roam_copyright "${CMAKE_MATCH_1}")
string(REGEX REPLACE "\n\n" "\n.\n" roam_license "${roam_license}")
string(REGEX REPLACE "\n(.)" "\n \\1" roam_license " ${roam_license}")

set(roam_about "roam moves a body, a person or a sphere, through any 3D scene, however
large, without ever passing through a wall. For each move it computes a
certified distance to the nearest triangle.")

roam_debian_package(program roam science "walk and fly through any 3D scene"
  "${roam_about}
.
This package has the program: it shows scenes, walks through them, finds
out what fits, and makes stores of scenes larger than memory."
  "roam-reader (= ${roam_debian_version})" fonts-dejavu-core)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libgl1-mesa-dri, libsdl2-2.0-0, libcurl4 | libcurl3-gnutls")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, roam-doc, xvfb")

roam_debian_package(reader roam-reader science "reader of 3D scenes for roam"
  "${roam_about}
.
This package has the child process that parses files of scenes behind
walls, for the program roam and for programs that use its libraries.")

roam_debian_package(library ${roam_library} libs "motion without collisions in 3D scenes, C interface"
  "${roam_about}
.
This package has the shared library for C, Python and other languages."
  "roam-reader (= ${roam_debian_version})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libcurl4 | libcurl3-gnutls")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/debian/library/triggers)

roam_debian_package(devel libroam-dev libdevel "motion without collisions in 3D scenes, development"
  "${roam_about}
.
This package has the headers, the static libraries for C++, and files for
CMake and pkg-config."
  "${roam_library} (= ${roam_debian_version})" libglm-dev libtbb-dev libhwy-dev libxxhash-dev libzstd-dev libssl-dev
  pkg-config)
set(CPACK_DEBIAN_DEVEL_PACKAGE_RECOMMENDS "cmake")
set(CPACK_DEBIAN_DEVEL_PACKAGE_SUGGESTS "libopenscenegraph-dev, roam-doc")

roam_debian_package(doc roam-doc doc "motion without collisions in 3D scenes, documents"
  "${roam_about}
.
This package has the documents and the examples.")

if(Python_EXECUTABLE)
  list(APPEND CPACK_COMPONENTS_ALL python)
  roam_debian_package(python python3-roam python "motion without collisions in 3D scenes, Python"
    "${roam_about}
.
This package has the module for Python 3."
    "python3:any (>= 3.9)" python3-numpy "${roam_library} (>= ${roam_debian_version})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      ${CMAKE_CURRENT_LIST_DIR}/debian/python/postinst ${CMAKE_CURRENT_LIST_DIR}/debian/python/prerm)
endif()

foreach(component IN ITEMS PROGRAM READER LIBRARY)
  set(CPACK_DEBIAN_${component}_PACKAGE_SHLIBDEPS ON)
endforeach()
foreach(component IN ITEMS DOC PYTHON)
  set(CPACK_DEBIAN_${component}_PACKAGE_ARCHITECTURE all)
endforeach()
include(CPack)
