# Writes FILE, a source that tells the commit of the tree SOURCE. A file that says so already stays as it is.
set(commit unknown)
find_package(Git QUIET)
if(Git_FOUND AND EXISTS ${SOURCE}/.git)  # not that of a repository around an unpacked archive
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                  OUTPUT_VARIABLE told RESULT_VARIABLE status ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(status EQUAL 0)
    set(commit ${told})
  endif()
endif()
file(CONFIGURE OUTPUT ${FILE} @ONLY CONTENT [[
#include "app/engine/version.h"

std::string ir::engine::commit() {
    return "@commit@";
}
]])
