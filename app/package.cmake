# `cpack -G DEB`, in a build folder: heml, the program with its scenes; libheml-dev, what other programs link. Shared
# libraries are found by dpkg-shlibdeps (Debian package dpkg-dev); those that the program opens by itself are named here.
set(CPACK_PACKAGE_VENDOR "the heml authors")
set(CPACK_PACKAGE_CONTACT "the heml authors <heml@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME heml)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libosmesa6)          # pictures without a display
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libglfw3, libgl1, libgl1-mesa-dri")  # the window
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libspnav0, spacenavd")  # its SpaceMouse
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The heml program, its scenes, meshes and materials.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libheml-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libfmt-dev, nlohmann-json3-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS heml)         # heml-mesher, for surfaces
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "The engine as static libraries, its headers and its CMake package.")
include(CPack)
