// Files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace nbvopt {

/// Writes `bytes` to a temporary file beside `path`, then renames it to `path`. Throws InputError
/// that names the path and says why when that fails: the folder is missing or not writable, the
/// disk is full. Then `path` is as it was and nothing else is left. A link is followed, and an
/// existing file keeps its permissions; a device or pipe is written in place.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for bytes in pieces.
void write_file_atomically(const std::filesystem::path& path,
                           std::span<const std::string_view> pieces);

/// The same; the file that it replaces, if any, remains as `backup_of(path)`, where it replaces an
/// older backup. At every moment the file's old or new content is there. A device has no backup.
void write_file_with_backup(const std::filesystem::path& path, std::string_view bytes);

/// The name of that backup: `path`.bak, beside what a link leads to.
std::filesystem::path backup_of(const std::filesystem::path& path);

/// The same for the file of that name in an open folder; a link is replaced, not followed. Throws
/// std::system_error.
void write_file_atomically_at(int folder, const std::string& name,
                              std::span<const std::string_view> pieces);

/// Throws InputError as write_file_atomically() would for a folder that is missing or not writable:
/// to refuse a file before the work whose result it should hold.
void require_writable(const std::filesystem::path& path);

/// Removes the temporary files of writers of `path` that were killed. Nobody may be writing it.
void remove_unfinished_files(const std::filesystem::path& path);

}  // namespace nbvopt
