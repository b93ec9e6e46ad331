#include "scenegraph/near_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kMaxLooked = 4096;
constexpr std::size_t kMaxNear = 5;
constexpr std::size_t kMaxEdits = 2;

std::string lowered(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower;
}

/// Levenshtein distance.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> nearNames(std::string_view wanted, std::span<const std::string> known) {
  const std::string lower = lowered(wanted);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& name : known.first(std::min(known.size(), kMaxLooked))) {
    const std::string other = lowered(name);
    const std::size_t length_gap = std::max(lower.size(), other.size()) - std::min(lower.size(), other.size());
    const std::size_t edits = length_gap <= kMaxEdits ? editDistance(lower, other) : kMaxEdits + 1;
    if (edits <= kMaxEdits && edits < lower.size()) {
      near.emplace_back(edits, name);
    } else if (lower.size() >= 3 && other.contains(lower)) {
      near.emplace_back(kMaxEdits + length_gap, name);
    }
  }
  std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(near.size(), kMaxNear); ++i) {
    names.push_back(std::move(near[i].second));
  }
  return names;
}

std::string quotedList(std::span<const std::string> names, std::size_t limit) {
  std::string text;
  for (const std::string& name : names.first(std::min(names.size(), limit))) {
    text += (text.empty() ? "'" : ", '") + name + "'";
  }
  return names.size() > limit ? text + " and " + std::to_string(names.size() - limit) + " more" : text;
}

std::string noSuch(std::string_view kind, std::string_view wanted, std::span<const std::string> known) {
  std::string text = "there is no ";
  text.append(kind).append(" '").append(wanted).append("'");
  const auto near = nearNames(wanted, known);
  if (known.empty()) {
    return text.append("; the recording has none");
  }
  return near.empty() ? text.append("; there are ").append(quotedList(known))
                      : text.append("; did you mean ").append(quotedList(near)).append("?");
}

}  // namespace stillframe::scenegraph
