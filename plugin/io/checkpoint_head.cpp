#include "synovia/io/checkpoint_head.hpp"

#include <sstream>

namespace synovia::checkpoint_head
{

std::string Text(std::size_t bytes, std::uint64_t sum)
{
   std::ostringstream text;
   text << magic << "\nbytes " << bytes << "\nsum " << std::hex << sum << "\n";
   std::string head = text.str();
   head.resize(size, '\0');
   return head;
}

} // namespace synovia::checkpoint_head
