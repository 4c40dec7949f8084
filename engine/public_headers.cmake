# The engine's public face. These headers, and what they include in turn, are what `cmake --install` installs; people
# include no others. Run at install time: cmake -DROOT=engine -DINCLUDES=folder (CMAKE_INSTALL_PREFIX/include) -P this.
cmake_minimum_required(VERSION 3.25)
set(public
  heml/base/error.hpp           # InputError
  heml/base/log.hpp             # warnings
  heml/mesh/tet_mesh.hpp
  heml/mesh/read.hpp
  heml/mesh/write.hpp
  heml/mesh/generate.hpp
  heml/mesh/quality.hpp
  heml/materials/material.hpp
  heml/materials/point.hpp      # a law at a deformation gradient
  heml/world/setup.hpp
  heml/world/command.hpp
  heml/world/world.hpp
  heml/scenario/scene.hpp       # scene files and recordings
  heml/scenario/solve.hpp
  heml/scenario/recorder.hpp
  heml/scenario/replay.hpp
  heml/session/frame.hpp
  heml/session/session.hpp)

set(left ${public})
set(all)
while(left)
  list(POP_FRONT left header)
  if(NOT header IN_LIST all)
    list(APPEND all ${header})
    file(STRINGS ${ROOT}/${header} includes REGEX "^#include <heml/")
    list(TRANSFORM includes REPLACE "^#include <([^>]+)>.*" "\\1")
    list(APPEND left ${includes})
  endif()
endwhile()
foreach(header IN LISTS all)
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL ${ROOT}/${header} DESTINATION ${INCLUDES}/${folder})
endforeach()
