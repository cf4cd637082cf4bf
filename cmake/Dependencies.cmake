# Every library the project uses, with the reason for it. Debian packages; `./dev setup` installs
# them. Licences in brackets.
#
#   fmt            core   numbers to text and error lines, as std::format is not in g++ 12  [MIT]
#   nlohmann-json  io     glTF's JSON, with unknown members kept in their order, and --json [MIT]
#   libspng        io     PNG out                                                          [BSD-2]
#   CLI11          cli    command line                                                     [BSD-3]
#   GoogleTest     tests                                                                   [BSD-3]
#   GoogleBenchmark bench                                                                  [Apache-2]
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)

find_package(PkgConfig REQUIRED)
pkg_check_modules(SPNG REQUIRED IMPORTED_TARGET spng)
add_library(wrapatlas_spng INTERFACE)
target_link_libraries(wrapatlas_spng INTERFACE PkgConfig::SPNG)

if(WRAPATLAS_CLI)
  find_package(CLI11 REQUIRED)
endif()
if(WRAPATLAS_TESTS)
  find_package(GTest REQUIRED)
endif()
if(WRAPATLAS_BENCH)
  find_package(benchmark REQUIRED)
endif()
