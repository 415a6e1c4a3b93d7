# One room of the architecture is one static library.
#   penumbra_room(NAME SOURCES … [PUBLIC targets…] [PRIVATE targets…])
# PUBLIC and PRIVATE are what it links; which room may link which is docs/architecture.md's
# picture, and tests/architecture checks the #includes against it.
function(penumbra_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    -Wno-sign-conversion -ffp-contract=off)
  if(PENUMBRA_DEV)
    target_compile_options(${target} PRIVATE -Werror -UNDEBUG)
  endif()
  if(PENUMBRA_SANITIZE)
    # GCC 12 takes std::regex for uninitialized where it is sanitized.
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined
      -fno-sanitize-recover=all -fno-omit-frame-pointer -Wno-maybe-uninitialized)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(PENUMBRA_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "clang-tidy-16;--quiet")
  endif()
endfunction()

function(penumbra_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(penumbra_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(penumbra_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(penumbra_${name} PUBLIC cxx_std_20)
  target_link_libraries(penumbra_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  penumbra_compile_options(penumbra_${name})
endfunction()

# For sources whose structs of vectors are copied in hot loops. GCC copies structs in halves of
# AVX's vectors, and a whole vector read back from two halves waits for both stores to end.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256" PENUMBRA_HAS_MOVE_MAX)
function(penumbra_copy_whole_vectors)
  if(PENUMBRA_HAS_MOVE_MAX)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS -mmove-max=256 -mstore-max=256)
  endif()
endfunction()
