#include "support/feb_text.hpp"
#include "support/feb_column_parts.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace synovia
{

std::string FebColumn()
{
   return R"(<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="4.0">
	<Module type="biphasic"/>
	<Control>
		<analysis>TRANSIENT</analysis>
		<time_steps>10</time_steps>
		<step_size>0.5</step_size>
		<solver type="biphasic"><dtol>0.001</dtol></solver>
	</Control>
	<Globals><Constants><T>0</T></Constants></Globals>
	<Material>
		<material id="1" name="tissue" type="biphasic">
			<phi0>0.3</phi0>
			<fluid_density>1</fluid_density>
			<solid type="neo-Hookean">
				<density>1</density>
				<E>2</E>
				<v>0.1</v>
			</solid>
			<permeability type="perm-Holmes-Mow">
				<perm>0.01</perm>
				<M>1.5</M>
				<alpha>2</alpha>
			</permeability>
		</material>
	</Material>
	<Mesh>
		<Nodes name="column">
			<node id="1">0,0,0</node>
			<node id="2">1,0,0</node>
			<node id="3">1,1,0</node>
			<node id="4">0,1,0</node>
			<node id="5">0,0,1</node>
			<node id="6">1,0,1</node>
			<node id="7">1,1,1</node>
			<node id="8">0,1,1</node>
			<node id="9">0,0,2</node>
			<node id="10">1,0,2</node>
			<node id="11">1,1,2</node>
			<node id="12">0,1,2</node>
		</Nodes>
		<Elements type="hex8" name="body">
			<elem id="1">1,2,3,4,5,6,7,8</elem>
			<elem id="2">5,6,7,8,9,10,11,12</elem>
		</Elements>
		<NodeSet name="all">1,2,3,4,5,6,7,8,9,10,11,12</NodeSet>
		<NodeSet name="bottom">1,2,3,4</NodeSet>
		<Surface name="top">
			<quad4 id="1">9,10,11,12</quad4>
		</Surface>
	</Mesh>
	<MeshDomains>
		<SolidDomain name="body" mat="tissue"/>
	</MeshDomains>
	<Boundary>
		<bc name="sides" node_set="all" type="zero displacement">
			<x_dof>1</x_dof>
			<y_dof>1</y_dof>
			<z_dof>0</z_dof>
		</bc>
		<bc name="support" node_set="bottom" type="zero displacement">
			<x_dof>0</x_dof>
			<y_dof>0</y_dof>
			<z_dof>1</z_dof>
		</bc>
		<bc name="drained" node_set="@surface:top" type="zero fluid pressure"/>
	</Boundary>
	<Loads>
		<surface_load name="press" surface="top" type="normal_traction">
			<traction lc="1">-0.5</traction>
			<linear>0</linear>
			<effective>0</effective>
		</surface_load>
	</Loads>
	<LoadData>
		<load_controller id="1" type="loadcurve">
			<interpolate>LINEAR</interpolate>
			<extend>CONSTANT</extend>
			<points>
				<pt>0,0</pt>
				<pt>1,2</pt>
			</points>
		</load_controller>
	</LoadData>
	<Output>
		<plotfile type="febio"><var type="displacement"/></plotfile>
	</Output>
</febio_spec>
)";
}

std::string FebPressedColumn()
{
   std::string text = Replaced(
      FebColumn(), "\t</Material>",
      R"(		<material id="2" name="plate" type="rigid body">
			<density>1</density>
			<center_of_mass>0,0,2</center_of_mass>
		</material>
	</Material>)");
   text = Replaced(text, "\t\t</Nodes>",
                   R"(			<node id="13">-1,-1,2.1</node>
			<node id="14">2,-1,2.1</node>
			<node id="15">2,2,2.1</node>
			<node id="16">-1,2,2.1</node>
		</Nodes>)");
   text = Replaced(text, "\t\t<NodeSet name=\"all\">",
                   R"(		<Elements type="quad4" name="shell">
			<elem id="3">13,14,15,16</elem>
		</Elements>
		<Surface name="below"><quad4 id="1">16,15,14,13</quad4></Surface>
		<SurfacePair name="pair">
			<primary>below</primary><secondary>top</secondary>
		</SurfacePair>
		<NodeSet name="all">)");
   text = Replaced(text, "\t</MeshDomains>",
                   R"(		<ShellDomain name="shell" mat="plate"/>
	</MeshDomains>)");
   // The contact says what the fluid does.
   text = Replaced(text,
                   "\t\t<bc name=\"drained\" node_set=\"@surface:top\" "
                   "type=\"zero fluid pressure\"/>\n",
                   "");
   return Replaced(text, "\t<Loads>", R"(	<Rigid>
		<rigid_bc type="rigid_fixed"><rb>plate</rb><Rx_dof>1</Rx_dof>
			<Ry_dof>1</Ry_dof><Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof>
			<Rw_dof>1</Rw_dof></rigid_bc>
		<rigid_load type="rigid_force"><rb>plate</rb><dof>Rz</dof>
			<value lc="1">-0.1</value></rigid_load>
	</Rigid>
	<Contact>
		<contact name="press" surface_pair="pair" type="sliding-biphasic"/>
	</Contact>
	<Loads>)");
}

std::string FebGuidedColumn()
{
   const std::pair<const char *, const char *> changes[] = {
      {"<permeability type=",
       R"(<solvent_supply type="Starling"><kp>0.02</kp><pv>0.3</pv>
			</solvent_supply>
			<permeability type=)"},
      {"</Material>",
       R"(	<material id="2" name="wall" type="rigid body">
			<center_of_mass>1,0,0</center_of_mass>
		</material>
	</Material>)"},
      {"</Nodes>",
       R"(	<node id="21">1,-1,-1</node>
			<node id="22">1,2,-1</node>
			<node id="23">1,2,3</node>
			<node id="24">1,-1,3</node>
		</Nodes>
		<Elements type="quad4" name="wall">
			<elem id="9">21,22,23,24</elem>
		</Elements>)"},
      {"<Surface name=\"top\">",
       R"(<NodeSet name="edge">2,6,10</NodeSet>
		<NodeSet name="front">1,2,5,6,9,10</NodeSet>
		<Surface name="side">
			<quad4 id="1">2,3,7,6</quad4>
			<quad4 id="2">6,7,11,10</quad4>
		</Surface>
		<Surface name="plane"><quad4 id="1">21,22,23,24</quad4></Surface>
		<SurfacePair name="keeps">
			<primary>side</primary>
			<secondary>plane</secondary>
		</SurfacePair>
		<Surface name="top">)"},
      {"</MeshDomains>",
       R"(	<ShellDomain name="wall" mat="wall"/>
	</MeshDomains>)"},
      {feb_column::fixed_sides,
       R"(<bc name="front" node_set="front" type="zero displacement">
			<y_dof>1</y_dof>
		</bc>
		<bc name="edge" node_set="edge" type="zero displacement">
			<x_dof>1</x_dof><y_dof>1</y_dof>
		</bc>)"},
      {"<Loads>",
       R"(<Rigid>
		<rigid_bc name="held" type="rigid_fixed"><rb>wall</rb>
			<Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof><Rz_dof>1</Rz_dof>
			<Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof><Rw_dof>1</Rw_dof>
		</rigid_bc>
	</Rigid>
	<Contact>
		<contact name="keeps" surface_pair="keeps" type="sliding-elastic">
			<penalty>10</penalty>
			<tension>1</tension>
		</contact>
	</Contact>
	<Loads>)"},
      {"<plotfile",
       R"(<logfile>
			<node_data data="ux;Rz" file="n.txt" node_set="front">3</node_data>
			<element_data data="sx;p" delim=",">1:2</element_data>
		</logfile>
		<plotfile)"}};
   std::string text = FebColumn();
   for (const auto &[old, other] : changes)
   {
      text = Replaced(text, old, other);
   }
   return text;
}

std::string FebSteppedColumn()
{
   std::string text = FebPressedColumn();
   const size_t control = text.find("\t<Control>");
   text.erase(control, text.find("\t<Globals>") - control);
   const size_t load = text.find("\t\t<rigid_load");
   text.erase(load, text.find("</rigid_load>") + 13 - load);
   const std::pair<const char *, const char *> changes[] = {
      {R"(<solid type="neo-Hookean">
				<density>1</density>
				<E>2</E>
				<v>0.1</v>
			</solid>)",
       R"(<mat_axis type="cylindrical"><center>3,0.5,0</center>
				<axis>0,1,0</axis><vector>1,0,0</vector></mat_axis>
			<solid type="solid mixture">
				<solid type="neo-Hookean"><E>2</E><v>0.1</v></solid>
				<solid type="fiber-NH"><mu>3</mu>
					<fiber type="map">dirs</fiber></solid>
			</solid>)"},
      {"\t<Boundary>",
       R"(	<MeshData>
		<ElementData name="dirs" data_type="vec3" elem_set="body">
			<elem lid="1">0,0,2</elem>
			<elem lid="2">1,0,1</elem>
		</ElementData>
	</MeshData>
	<Boundary>)"},
      {"</Material>",
       R"(	<material id="3" name="post" type="rigid body">
			<center_of_mass>0.5,0.5,0</center_of_mass>
		</material>
	</Material>)"},
      {feb_column::fixed_bottom,
       R"(<bc name="support" node_set="bottom" type="rigid">
			<rb>post</rb>
		</bc>)"},
      {feb_column::fixed_sides, ""},
      {R"(<rb>plate</rb><Rx_dof>1</Rx_dof>
			<Ry_dof>1</Ry_dof>)",
       R"(<rb>post</rb><Rx_dof>1</Rx_dof>
			<Ry_dof>1</Ry_dof><Rz_dof>1</Rz_dof>)"},
      {"\t</Rigid>",
       R"(		<rigid_connector name="guide" type="rigid prismatic joint">
			<body_a>post</body_a><body_b>plate</body_b>
			<joint_origin>0.5,0.5,0</joint_origin>
			<translation_axis>0,0,1</translation_axis>
			<transverse_axis>1,0,0</transverse_axis>
		</rigid_connector>
	</Rigid>
	<Constraints>
		<constraint type="linear constraint">
			<linear_constraint><node id="1" bc="y">1</node></linear_constraint>
			<linear_constraint><node id="2" bc="y">1</node></linear_constraint>
			<linear_constraint><node id="5" bc="y">1</node></linear_constraint>
			<linear_constraint><node id="6" bc="y">1</node></linear_constraint>
		</constraint>
	</Constraints>)"},
      {"\t<LoadData>",
       R"(	<Step>
		<step id="1" name="press">
			<Control><time_steps>4</time_steps><step_size>0.25</step_size></Control>
			<Rigid>
				<rigid_load type="rigid_force"><rb>plate</rb><dof>Rz</dof>
					<value lc="1">-0.1</value></rigid_load>
			</Rigid>
		</step>
		<step id="2" name="hold">
			<Control><time_steps>2</time_steps><step_size>1</step_size></Control>
			<Rigid>
				<rigid_bc type="rigid_fixed"><rb>plate</rb><Rz_dof>1</Rz_dof>
				</rigid_bc>
			</Rigid>
		</step>
	</Step>
	<LoadData>)"}};
   for (const auto &[old, other] : changes)
   {
      text = Replaced(text, old, other);
   }
   return text;
}

std::string Replaced(const std::string &text, const std::string &old,
                     const std::string &other)
{
   const size_t at = text.find(old);
   if (at == std::string::npos)
   {
      throw std::runtime_error("the text has no " + old);
   }
   return text.substr(0, at) + other + text.substr(at + old.size());
}

int LineOf(const std::string &text, const std::string &part)
{
   const size_t at = text.find(part);
   if (at == std::string::npos)
   {
      throw std::runtime_error("the text has no " + part);
   }
   return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

} // namespace synovia
