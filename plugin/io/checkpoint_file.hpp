#pragma once

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// What a checkpoint holds, by name. For one process, as all here; errors are
/// std::runtime_error with the name of the file and the reason.
struct CheckpointContents
{
   std::map<std::string, std::string> texts;
   std::map<std::string, double> numbers;
   std::map<std::string, std::vector<double>> fields;
};

/// Writes the file, in place of one that is there, such that it is whole or not
/// there after whatever happens, a crash of the machine included.
void WriteCheckpointFile(const std::string &path,
                         const CheckpointContents &contents);

/// Reads a file and verifies its sum, which covers every byte.
CheckpointContents ReadCheckpointFile(const std::string &path);

/// Throws if it is not a whole checkpoint; does not take it apart.
void VerifyCheckpointFile(const std::string &path);

} // namespace synovia
