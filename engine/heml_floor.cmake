# heml_floor(NAME [LIBRARIES others...])
#
# One floor of the engine: every .cpp of engine/heml/NAME, as target heml::NAME, linked with the floors named before it. The
# order of the calls is the order of the floors, which HEML_FLOORS keeps; tests/floors.cmake reads the includes against it.
function(heml_floor name)
  cmake_parse_arguments(FLOOR "" "" "LIBRARIES" ${ARGN})
  get_property(above GLOBAL PROPERTY HEML_FLOORS)
  set_property(GLOBAL APPEND PROPERTY HEML_FLOORS ${name})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/engine/heml/${name}/*.cpp)
  set(kind STATIC)
  set(public PUBLIC)
  if(NOT sources)  # headers alone
    set(kind INTERFACE)
    set(public INTERFACE)
  endif()
  add_library(heml_${name} ${kind} ${sources})
  add_library(heml::${name} ALIAS heml_${name})
  set_target_properties(heml_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(heml_${name} ${public} cxx_std_20)
  target_include_directories(heml_${name} ${public}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/engine> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM above PREPEND heml::)
  target_link_libraries(heml_${name} ${public} ${above} ${FLOOR_LIBRARIES})
  install(TARGETS heml_${name} EXPORT heml ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endfunction()
