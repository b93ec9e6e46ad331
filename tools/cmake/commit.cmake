# Writes HEADER with the commit of the working folder, where it is another than the one there.
execute_process(COMMAND git describe --always --dirty --exclude=* OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT "${HEADER}" CONTENT "#pragma once\n\n#define STILLFRAME_COMMIT \"@commit@\"\n" @ONLY)
