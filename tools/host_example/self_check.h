#pragma once

namespace host_example {

class HostWindow;

/// Uses the window as a person would, and checks what it shows. Returns the exit code; says what fails.
int checkHost(HostWindow& window);

}  // namespace host_example
