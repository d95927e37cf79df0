#pragma once

/// Parts of FebColumn(), to be replaced by others.
namespace synovia::feb_column
{

inline const char *const fixed_sides =
   R"(<bc name="sides" node_set="all" type="zero displacement">
			<x_dof>1</x_dof>
			<y_dof>1</y_dof>
			<z_dof>0</z_dof>
		</bc>)";
inline const char *const fixed_bottom =
   R"(<bc name="support" node_set="bottom" type="zero displacement">
			<x_dof>0</x_dof>
			<y_dof>0</y_dof>
			<z_dof>1</z_dof>
		</bc>)";
inline const char *const drained =
   R"(<bc name="drained" node_set="@surface:top" type="zero fluid pressure"/>)";
inline const char *const bottom_nodes =
   R"(<NodeSet name="bottom">1,2,3,4</NodeSet>)";
/// Another set, which the column doesn't have.
inline const char *const top_nodes =
   R"(<NodeSet name="lid"><n id="9"/><n id="10"/><n id="11"/><n id="12"/>
		</NodeSet>)";

} // namespace synovia::feb_column
