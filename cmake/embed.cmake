# penumbra_embed(TARGET FUNCTION FILES…): texts become part of the program. Adds a source file that
# defines std::string_view penumbra::FUNCTION(std::string_view name), the text of the file of that
# name (without folder), empty if there is none.
function(penumbra_embed target function)
  set(entries "")
  foreach(file ${ARGN})
    get_filename_component(path ${file} ABSOLUTE)
    get_filename_component(name ${file} NAME)
    file(READ ${path} text)
    string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  file(CONFIGURE OUTPUT ${output} CONTENT [[#include <string_view>

namespace penumbra {
namespace {

struct Text {
  std::string_view name, text;
};
constexpr Text texts[] = {
@entries@};

}  // namespace

std::string_view @function@(std::string_view name);
std::string_view @function@(std::string_view name) {
  for (const Text& t : texts)
    if (t.name == name) return t.text;
  return {};
}

}  // namespace penumbra
]] @ONLY)
  target_sources(${target} PRIVATE ${output})
endfunction()
