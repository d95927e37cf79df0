#include "synovia/feb/feb_element_data.hpp"
#include "synovia/feb/feb_ranges.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Calls read(entry, number) for each entry of a list, by its place in the set.
template <typename Read>
void ForEntries(const FebInput &list, const std::vector<long long> &set,
                const Read &read)
{
   for (const FebInput &entry : list.All())
   {
      const long long place = entry.NeededNumber("lid");
      if (place < 1 || place > static_cast<long long>(set.size()))
      {
         entry.Stop("the set has no element " + std::to_string(place));
      }
      else
      {
         read(entry, set[place - 1]);
      }
   }
}

void ReadAxesOf(const FebInput &list, const std::vector<long long> &set,
                FebElementData &data)
{
   ForEntries(list, set,
              [&](const FebInput &entry, long long number)
              {
                 const std::optional<FebInput> a = entry.Find("a");
                 const std::optional<FebInput> d = entry.Find("d");
                 if (!a || !d)
                 {
                    entry.Stop("<a> and <d> must be there");
                    return;
                 }
                 data.axes[number] =
                    AxesAcross(ReadVector(*a), ReadVector(*d), entry);
              });
}

void ReadVectorsOf(const FebInput &list, const std::vector<long long> &set,
                   FebElementData::Vectors &vectors)
{
   ForEntries(list, set,
              [&](const FebInput &entry, long long number)
              { vectors[number] = UnitVector(ReadVector(entry), entry); });
}

bool IsOfFibers(const std::string &type)
{
   const std::string end = ".fiber";
   return type == "fiber" ||
          (type.size() > end.size() &&
           type.compare(type.size() - end.size(), end.size(), end) == 0);
}

void ReadList(const FebInput &list, const FebInput &root, const FebMesh &mesh,
              FebElementData &data)
{
   // Before version 4.0 the type was a variable.
   const std::string type =
      list.HasAttribute("var") ? list.Attribute("var") : list.Attribute("type");
   if (type == "shell thickness")
   {
      list.IgnoreAll("only rigid shells are read");
      return;
   }
   const std::string name = list.Attribute("name");
   const std::string set = list.NeededAttribute("elem_set");
   const std::vector<long long> numbers = ElementsOfSet(set, root, mesh);
   if (numbers.empty())
   {
      list.StopAll("there is no set of elements called \"" + set + "\"");
   }
   else if (type == "mat_axis")
   {
      ReadAxesOf(list, numbers, data);
   }
   else if (IsOfFibers(type))
   {
      ReadVectorsOf(list, numbers, data.fibers);
   }
   else if (type.empty() && list.Attribute("data_type") == "vec3")
   {
      ReadVectorsOf(list, numbers, data.maps[name]);
   }
   else
   {
      list.StopAll("data of elements are only known of mat_axis, fiber, and "
                   "of vectors (data_type=\"vec3\")");
   }
}
} // namespace

FebElementData ReadElementData(const FebInput &root, const FebMesh &mesh)
{
   FebElementData data;
   if (const std::optional<FebInput> section = root.Find("MeshData"))
   {
      for (const FebInput &list : section->All("ElementData"))
      {
         ReadList(list, root, mesh, data);
      }
   }
   return data;
}

std::vector<long long> ElementsOfSet(const std::string &name,
                                     const FebInput &root, const FebMesh &mesh)
{
   std::vector<long long> numbers;
   for (const FebPart &part : mesh.parts)
   {
      for (const FebCell &cell : part.cells)
      {
         if (part.name == name)
         {
            numbers.push_back(cell.number);
         }
      }
   }
   for (const char *section : {"Mesh", "Geometry"})
   {
      const std::optional<FebInput> found = root.Find(section);
      for (const FebInput &set :
           found ? found->All("ElementSet") : std::vector<FebInput>())
      {
         if (set.Attribute("name") != name)
         {
            continue;
         }
         const std::vector<long long> listed = ReadRanges(set);
         numbers.insert(numbers.end(), listed.begin(), listed.end());
         for (const FebInput &element : set.All())
         {
            numbers.push_back(element.NeededNumber("id"));
         }
      }
   }
   return numbers;
}

Point3 UnitVector(const Point3 &vector, const FebInput &where)
{
   const real_t length = Length(vector);
   if (!(length > 0.0))
   {
      where.Stop("the direction is zero");
      return {1.0, 0.0, 0.0};
   }
   return {vector[0] / length, vector[1] / length, vector[2] / length};
}

Tensor3<> InColumns(const std::array<Point3, 3> &columns)
{
   Tensor3<> tensor;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         tensor[i][j] = columns[j][i];
      }
   }
   return tensor;
}

Tensor3<> AxesAcross(const Point3 &a, const Point3 &d, const FebInput &where)
{
   const Point3 first = UnitVector(a, where);
   const Point3 third = UnitVector(Cross(first, d), where);
   return InColumns({first, Cross(third, first), third});
}

Point3 ReadVector(const FebInput &from)
{
   const std::vector<real_t> x = from.Numbers();
   if (x.size() != 3)
   {
      from.Stop("a vector has three components");
      return {1.0, 0.0, 0.0};
   }
   return {x[0], x[1], x[2]};
}

} // namespace synovia
