# Flags every target of the project is built with. No contraction of a*b+c: a build gives the same bits wherever it runs.
# Nobody reads errno or floating-point exceptions, which lets loops with a choice in them be vectorised.
add_library(heml_options INTERFACE)
add_library(heml::options ALIAS heml_options)
target_compile_features(heml_options INTERFACE cxx_std_20)
target_compile_options(heml_options INTERFACE -ffp-contract=off -fno-trapping-math -fno-math-errno
  $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wshadow -Wno-psabi
    $<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-pragmas>>)
if(HEML_SANITIZE)
  # A target that says HEML_ARITHMETIC is loops over floats: nothing in them is undefined, and looking takes minutes to compile.
  target_compile_options(heml_options INTERFACE -fsanitize=${HEML_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<$<BOOL:$<TARGET_PROPERTY:HEML_ARITHMETIC>>:-fno-sanitize=undefined>)
  target_link_options(heml_options INTERFACE -fsanitize=${HEML_SANITIZE})
endif()
if(HEML_FUZZ)
  target_compile_options(heml_options INTERFACE $<$<BOOL:$<TARGET_PROPERTY:HEML_READS_FILES>>:-fsanitize=fuzzer-no-link>)
endif()

# heml_floor(NAME DEPENDS floors... LIBRARIES others...)
#
# One floor of the engine: every .cpp of its folder, as target heml::NAME. Its headers are seen as <heml/NAME/...>, and only
# by targets that name the floor: each floor has an include root of its own, a folder in the build tree that holds a link
#   include/NAME/heml/NAME -> engine/NAME
# so an include of a floor that is not among DEPENDS does not compile.
function(heml_floor name)
  cmake_parse_arguments(FLOOR "" "" "DEPENDS;LIBRARIES" ${ARGN})
  set(source ${PROJECT_SOURCE_DIR}/engine/${name})
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${root}/heml)
  file(CREATE_LINK ${source} ${root}/heml/${name} SYMBOLIC)
  file(GLOB sources CONFIGURE_DEPENDS ${source}/*.cpp)
  set(kind STATIC)
  set(public PUBLIC)
  if(NOT sources)  # headers alone
    set(kind INTERFACE)
    set(public INTERFACE)
  endif()
  add_library(heml_${name} ${kind} ${sources})
  add_library(heml::${name} ALIAS heml_${name})
  set_target_properties(heml_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(heml_${name} ${public}
    $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM FLOOR_DEPENDS PREPEND heml::)
  target_link_libraries(heml_${name} ${public} heml::options ${FLOOR_DEPENDS} ${FLOOR_LIBRARIES})
  install(TARGETS heml_${name} EXPORT heml ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${source}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/heml/${name} FILES_MATCHING PATTERN "*.hpp")
endfunction()
