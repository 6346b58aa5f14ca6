// For engines that bring workers of their own: units on their way out, answers on their way back.
#pragma once

#include <cstddef>
#include <functional>
#include <istream>
#include <span>
#include <string>
#include <vector>

#include "experiment/record_file.hpp"
#include "experiment/work.hpp"

namespace nbvopt::experiment {

/// Visits the units `to_do`, ascending, as lines that workers take. A line has one more key,
/// "engine", which workers pass over: "timeout_s"; "reads" and "writes", JSON pointers to where the
/// unit names files; and "after", the id of a unit of another line that must have succeeded, and
/// its files be there, before this one can run.
void list_units(Work& work, std::span<const std::size_t> to_do, double timeout_s,
                const std::function<void(const std::string& line)>& visit);

/// Keeps the answers of workers, a line each: every record is in its file before the next line is
/// read, and then on_kept(id) is told of its unit. `has_answer` tells of every unit of the work
/// whether it has an answer, which it keeps. Throws InputError that names the line of what is no
/// answer to a unit of the work, and as RecordFile::append().
void record_answers(Work& work, std::vector<bool> has_answer, RecordFile& records,
                    std::istream& answers,
                    const std::function<void(const std::string& id)>& on_kept);

}  // namespace nbvopt::experiment
