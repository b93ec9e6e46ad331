#include "nodes/tf_axes/frame_list.h"

namespace stillframe::nodes {

FrameNameSet splitFrameNames(std::string_view list) {
  FrameNameSet names;
  std::string name;
  std::size_t kept = 0;  // of `name`, up to its last character that is no blank
  const auto finish = [&] {
    name.resize(kept);
    if (!name.empty()) {
      names.insert(name);
    }
    name.clear();
    kept = 0;
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool is_escaped = list[i] == '\\' && i + 1 < list.size();
    if (list[i] == ',') {
      finish();
    } else if (is_escaped || list[i] != ' ' || !name.empty()) {
      i += is_escaped ? 1 : 0;
      name += list[i];
      kept = is_escaped || list[i] != ' ' ? name.size() : kept;
    }
  }
  finish();
  return names;
}

std::string joinFrameNames(const FrameNameSet& names) {
  std::string list;
  for (const std::string& name : names) {
    list += list.empty() ? "" : ", ";
    for (const char letter : name) {
      list += letter == ',' || letter == '\\' ? "\\" : "";
      list += letter;
    }
  }
  return list;
}

}  // namespace stillframe::nodes
