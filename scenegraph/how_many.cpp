#include "scenegraph/how_many.h"

#include <array>
#include <utility>

namespace stillframe::scenegraph {

std::string nounOf(std::uint64_t count, std::string_view plural) {
  // The longer endings first.
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kEndings{
      {{"axes", "axis"}, {"ices", "ex"}, {"ies", "y"}, {"shes", "sh"}, {"boxes", "box"}, {"s", ""}}};
  if (count == 1) {
    for (const auto& [several, one] : kEndings) {
      if (plural.ends_with(several)) {
        return std::string(plural.substr(0, plural.size() - several.size())).append(one);
      }
    }
  }
  return std::string(plural);
}

std::string howMany(std::uint64_t count, std::string_view plural) {
  return std::to_string(count) + " " + nounOf(count, plural);
}

}  // namespace stillframe::scenegraph
