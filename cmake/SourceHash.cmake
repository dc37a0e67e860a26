# Writes version.cpp with a hash of everything that shapes pixels; run at every build, rewrites only on change.
file(GLOB_RECURSE files LIST_DIRECTORIES false "${SOURCE_DIR}/src/*.cpp" "${SOURCE_DIR}/src/*.h"
     "${SOURCE_DIR}/data/*" "${SOURCE_DIR}/shaders/*" "${SOURCE_DIR}/tools/embed_*.cpp")
list(SORT files)
set(all "")
foreach(file IN LISTS files)
  file(SHA256 "${file}" digest)
  file(RELATIVE_PATH name "${SOURCE_DIR}" "${file}")
  string(APPEND all "${name} ${digest}\n")
endforeach()
string(SHA256 total "${all}")
set(text "#include \"core/version.h\"

namespace skylapse {

const char* const kVersion = \"${VERSION}\";
const char* const kSourceHash = \"${total}\";

}  // namespace skylapse
")
set(old "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old)
endif()
if(NOT old STREQUAL text)
  file(WRITE "${OUTPUT}" "${text}")
endif()
