/// The families of courses, by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bench/proxies/course.h"

namespace touchmark::bench::experiments::proxy {

using proxies::Course;

/// Makes courses of about `ticks` in all. Equal seeds and numbers give equal ones, on every machine.
using MakeCourses = std::vector<Course> (*)(std::uint64_t seed, std::size_t ticks);

struct Family {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  MakeCourses make = nullptr;
};

/// In the order of the report.
std::span<const Family> families();

/// Throws std::invalid_argument naming the nearest names.
const Family& family_named(std::string_view name);

}  // namespace touchmark::bench::experiments::proxy
