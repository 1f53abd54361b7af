#pragma once

#include <stdexcept>
#include <string>

namespace integrators {

// The system could not be evaluated at a time: "<what> at t = <time> s".
class IntegrationError : public std::runtime_error {
 public:
  IntegrationError(const std::string& what, double time)
      : std::runtime_error(what + " at t = " + std::to_string(time) + " s"),
        time_(time) {}
  double time() const { return time_; }

 private:
  double time_;
};

}  // namespace integrators
