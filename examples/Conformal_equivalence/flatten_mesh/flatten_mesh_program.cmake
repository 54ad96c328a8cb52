# Created by the developers of Conformal_equivalence, in the form of CGAL's packages.
# The program flatten_mesh as a library, so that it is compiled once: the program itself, its tests and its fuzz test are
# linked with it. The folders examples/ and test/ include this file, after CGAL and Eigen are found.

find_package(Boost QUIET OPTIONAL_COMPONENTS program_options)
find_package(nlohmann_json QUIET)

set(flatten_mesh_folder "${CMAKE_CURRENT_LIST_DIR}")

# flatten_mesh_add_library(<name> [<flag>...]): a library, compiled with these flags. There is none without
# Boost.Program_options; nothing happens if it is there already.
function(flatten_mesh_add_library name)
  if(TARGET ${name} OR NOT TARGET Boost::program_options)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS "${flatten_mesh_folder}/*.cpp")
  # the page of --html, as a source
  file(GLOB page_files CONFIGURE_DEPENDS "${flatten_mesh_folder}/page/*" "${flatten_mesh_folder}/page/three/three.js")
  set(page_source "${CMAKE_CURRENT_BINARY_DIR}/${name}_page_template.cpp")
  add_custom_command(OUTPUT "${page_source}" DEPENDS ${page_files} VERBATIM
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${page_source}" -P "${flatten_mesh_folder}/page/embed_page.cmake")
  add_library(${name} STATIC ${sources} "${page_source}")
  set_target_properties(${name} PROPERTIES UNITY_BUILD "${CONFORMAL_EQUIVALENCE_UNITE_PROGRAM}" UNITY_BUILD_BATCH_SIZE 9)
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_compile_options(${name} PRIVATE ${ARGN})
  target_link_libraries(${name} PUBLIC CGAL::CGAL CGAL::Eigen3_support Boost::program_options)
  if(TARGET nlohmann_json::nlohmann_json) # its reports, with --report
    target_link_libraries(${name} PUBLIC nlohmann_json::nlohmann_json)
    target_compile_definitions(${name} PUBLIC CGAL_CONFORMAL_EQUIVALENCE_USE_JSON)
  endif()
endfunction()
