# Writes OUTPUT, the header of service/build_facts.cpp; run in every build, rewritten only when something differs.
#   cmake -DSOURCE=DIR -DTEMPLATE=FILE -DOUTPUT=FILE -DCOMPILER=TEXT -DFLAGS=TEXT -P build_facts.cmake
set(COMMIT "unknown")
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND ${GIT} -C "${SOURCE}" describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0)
    set(COMMIT "${described}")
  endif()
endif()
string(STRIP "${FLAGS}" FLAGS)
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
