#pragma once

#include <filesystem>

namespace stillframe::test {

/// The folder of the recordings that no one here made; tests that need it are registered only where it exists.
inline const std::filesystem::path kData = STILLFRAME_TEST_DATA;

}  // namespace stillframe::test
