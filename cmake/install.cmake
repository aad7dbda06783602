# The install: libraries, headers, the program and the CMake package, so that find_package(gridcull) gives
# gridcull::core, gridcull::grid, gridcull::methods and gridcull::sim.
include(CMakePackageConfigHelpers)

set(installed gridcull_settings)
set(GRIDCULL_DEPENDENCIES "find_dependency(glm)\nfind_dependency(Threads)\nfind_dependency(TBB CONFIG)")
foreach(part core grid methods sim)
  if(TARGET gridcull_${part})
    list(APPEND installed gridcull_${part})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${part} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gridcull FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()

# The libraries are static, so whoever links them must find what they use inside as well: ask the targets,
# since some of it (Embree) is used only where it was found.
set(linked "")
foreach(target ${installed})
  get_target_property(libraries ${target} LINK_LIBRARIES)
  list(APPEND linked ${libraries})
endforeach()
foreach(known "embree|find_dependency(embree 3 CONFIG)" "assimp::assimp|find_dependency(assimp CONFIG)" "ZLIB::ZLIB|find_dependency(ZLIB)"
              "pugixml::pugixml|find_dependency(pugixml)" "nlohmann_json::nlohmann_json|find_dependency(nlohmann_json)")
  string(REPLACE "|" ";" known "${known}")
  list(GET known 0 library)
  list(GET known 1 line)
  if("${library}" IN_LIST linked)
    string(APPEND GRIDCULL_DEPENDENCIES "\n${line}")
  endif()
endforeach()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gridcull)
install(TARGETS ${installed} EXPORT gridcull_targets)
if(TARGET gridcull)
  install(TARGETS gridcull)
  get_target_property(service_definitions gridcull_service INTERFACE_COMPILE_DEFINITIONS)
  if("GRIDCULL_WITH_SERVER" IN_LIST service_definitions)
    # The client is one header that needs nothing of the rest.
    install(FILES ${PROJECT_SOURCE_DIR}/service/client/gridcull_client.h
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gridcull/service/client)
    configure_file(service/packaging/gridcull.service.in ${PROJECT_BINARY_DIR}/gridcull.service @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/gridcull.service DESTINATION lib/systemd/system)
  endif()
endif()
install(EXPORT gridcull_targets FILE gridcull-targets.cmake NAMESPACE gridcull:: DESTINATION ${package_dir})
configure_package_config_file(cmake/gridcull-config.cmake.in ${PROJECT_BINARY_DIR}/gridcull-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gridcull-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gridcull-config.cmake ${PROJECT_BINARY_DIR}/gridcull-config-version.cmake
  DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
