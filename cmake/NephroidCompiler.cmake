# A linker that is several times as fast, where there is one: every test program links the whole library.
if(NEPHROID_TESTS)
  find_program(NEPHROID_LLD NAMES ld.lld)
  mark_as_advanced(NEPHROID_LLD)
  if(NEPHROID_LLD)
    add_link_options(-fuse-ld=lld)
  endif()
endif()

include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-Wmissing-designated-field-initializers NEPHROID_KNOWS_DESIGNATED_WARNING)

# One place for how every target of ours is compiled.
function(nephroid_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic
                         $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>)
  # What a designated initializer leaves out has its default on purpose. Clang has a warning of its own for it since version 19; of
  # gcc, it is one with that for lists without names.
  if(NEPHROID_KNOWS_DESIGNATED_WARNING)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-missing-designated-field-initializers>)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-missing-field-initializers>)
    # Says wrong things of std::string's operator+ (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(NEPHROID_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(NEPHROID_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${NEPHROID_SANITIZE} -fno-omit-frame-pointer
                                            -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${NEPHROID_SANITIZE})
  endif()
endfunction()
