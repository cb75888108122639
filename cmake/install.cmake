# cmake --install, and find_package(roam) with the target roam::roam.
#
# Each library is an export set of its own, so that a program that only uses the core needs no library of the readers.
# find_package(roam) finds glm and TBB; find_package(roam COMPONENTS import) also finds the dependencies of
# roam::import.
#
# The components of the installation are Debian's packages (cmake/debian.cmake): program, reader, library, devel, python,
# doc.
include(CMakePackageConfigHelpers)
set(roam_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/roam)

# roam_install(TARGET COMPONENT): installs a library as roam::COMPONENT.
function(roam_install target component)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
  install(TARGETS ${target} EXPORT roam-${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT devel
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT devel)
  install(EXPORT roam-${component} NAMESPACE roam:: DESTINATION ${roam_package_dir} COMPONENT devel)
endfunction()

roam_install(roam roam)
install(DIRECTORY include/roam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT devel)
if(ROAM_TOOLS)
  foreach(component IN ITEMS c files process import generate store ways profile training)
    roam_install(roam_${component} ${component})
  endforeach()
  file(RELATIVE_PATH roam_pc_to_include /${CMAKE_INSTALL_LIBDIR}/pkgconfig /${CMAKE_INSTALL_INCLUDEDIR})
  configure_file(cmake/roam.pc.in roam.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/roam.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT devel)
  roam_install(roam_osg osgRoam)
  install(DIRECTORY include/osgRoam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT devel)
  install(TARGETS roam_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # The program looks for it there. It is not in bin, because it is not a command for people.
  install(TARGETS roam-reader RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/roam COMPONENT reader)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/reference/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR} COMPONENT program)
  set(roam_desktop_dir apps/roam/desktop)
  install(FILES ${roam_desktop_dir}/roam.desktop DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/applications COMPONENT program)
  install(FILES ${roam_desktop_dir}/roam.xml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/mime/packages COMPONENT program)
  install(FILES ${roam_desktop_dir}/roam.svg DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/icons/hicolor/scalable/apps
          COMPONENT program)
endif()

install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT doc)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)

configure_package_config_file(cmake/roamConfig.cmake.in roamConfig.cmake INSTALL_DESTINATION ${roam_package_dir})
write_basic_package_version_file(roamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/roamConfig.cmake ${PROJECT_BINARY_DIR}/roamConfigVersion.cmake
        DESTINATION ${roam_package_dir} COMPONENT devel)
