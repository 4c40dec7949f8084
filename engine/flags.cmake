# What every target of the project is compiled with, and nothing that links an installed heml. No contraction of a*b+c: a
# build gives the same bits wherever it runs. Nobody reads errno or floating-point exceptions, which lets loops with a
# choice in them be vectorised. Where files are compiled in batches, what is local in one may be named as what is global in
# another: GCC then tells of names that hide other local ones, and of all where each is compiled by itself (preset debug).
add_compile_options(-ffp-contract=off -fno-trapping-math -fno-math-errno
  "$<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wno-psabi>"
  "$<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-shadow;-Wshadow=local>"
  "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-unknown-pragmas>")
if(HEML_SANITIZE)
  # A target that says HEML_ARITHMETIC is loops over floats: nothing in them is undefined, and looking takes minutes to compile.
  add_compile_options(-fsanitize=${HEML_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<$<BOOL:$<TARGET_PROPERTY:HEML_ARITHMETIC>>:-fno-sanitize=undefined>)
  add_link_options(-fsanitize=${HEML_SANITIZE})
endif()
if(HEML_FUZZ)
  add_compile_options($<$<BOOL:$<TARGET_PROPERTY:HEML_READS_FILES>>:-fsanitize=fuzzer-no-link>)
endif()

# heml_seldom_runs(TARGETS...): read files, write messages, fill the panel: nothing in them is worth the time that optimising
# it takes to compile. A build's bits do not depend on it.
function(heml_seldom_runs)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>>:-O1>)
  endforeach()
endfunction()
