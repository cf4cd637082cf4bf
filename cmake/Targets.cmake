# How every target of the project is compiled.

function(wrapatlas_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                         -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast)
  if(WRAPATLAS_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(CMAKE_UNITY_BUILD) # names of one file are hidden by those of another
    target_compile_options(${target} PRIVATE -Wno-shadow)
  endif()
  # The same bits on every machine: no fused multiply-add behind the source's back.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # Popcount and rounding in hardware: every x86 processor since 2009.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    target_compile_options(${target} PRIVATE -march=x86-64-v2)
  endif()
  if(WRAPATLAS_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${WRAPATLAS_SANITIZE}
                           -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
    target_link_options(${target} PUBLIC -fsanitize=${WRAPATLAS_SANITIZE})
  endif()
endfunction()

# For code in which no time is spent: optimising it takes longer than all the rest.
function(wrapatlas_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-Og>)
endfunction()

# Headers that take longer to read than the files that use them. Not what clang builds: it has to
# find what a file forgot to include.
function(wrapatlas_read_once target)
  if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# A library from all sources of the named folders below src/. wrapatlas_x is wrapatlas::x outside.
function(wrapatlas_library target)
  set(sources "")
  foreach(folder IN LISTS ARGN)
    file(GLOB found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${folder}/*.cpp)
    list(APPEND sources ${found})
    # As a unity build: files of one folder together, as their names differ.
    set(number 0)
    foreach(source IN LISTS found)
      math(EXPR group "${number} / 8")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${group})
      math(EXPR number "${number} + 1")
    endforeach()
  endforeach()
  add_library(${target} ${sources})
  string(REPLACE wrapatlas_ "" name ${target})
  add_library(wrapatlas::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name}
                        UNITY_BUILD_MODE GROUP VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  wrapatlas_compile_options(${target})
endfunction()
