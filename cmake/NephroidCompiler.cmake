# A linker that is several times as fast, where there is one: every test program links the whole library.
if(NEPHROID_TESTS)
  find_program(NEPHROID_LLD NAMES ld.lld)
  mark_as_advanced(NEPHROID_LLD)
  if(NEPHROID_LLD)
    add_link_options(-fuse-ld=lld)
  endif()
endif()

# One place for how every target of ours is compiled.
function(nephroid_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic
                         $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # What a designated initialiser leaves out has its default on purpose.
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
