# C# projects for IDEs, build/ide/Collektive.slnx. The build does not use them.
set(IDE "${COLLEKTIVE_BUILD}/ide")
file(READ "${UNITY}/Runtime/Bridge/csc.rsp" defines)
string(REGEX REPLACE "^-define:|\n" "" defines "${defines}")
file(CONFIGURE OUTPUT "${IDE}/Directory.Build.props" CONTENT [[
<Project>
  <PropertyGroup>
    <TargetFramework>netstandard2.1</TargetFramework>
    <AllowUnsafeBlocks>true</AllowUnsafeBlocks>
    <DefineConstants>@defines@</DefineConstants>
    <EnableDefaultItems>false</EnableDefaultItems>
    <GenerateAssemblyInfo>false</GenerateAssemblyInfo>
    <GenerateTargetFrameworkAttribute>false</GenerateTargetFrameworkAttribute>
    <BaseIntermediateOutputPath>$(MSBuildThisFileDirectory)$(MSBuildProjectName)/obj/</BaseIntermediateOutputPath>
    <BaseOutputPath>$(MSBuildThisFileDirectory)$(MSBuildProjectName)/bin/</BaseOutputPath>
  </PropertyGroup>
</Project>
]] @ONLY)

# ide_project(ASSEMBLY SOURCES REFERENCES)
function(ide_project ASSEMBLY SOURCES REFERENCES)
  get_property(projects GLOBAL PROPERTY IDE_PROJECTS)
  cmake_path(GET ASSEMBLY STEM LAST_ONLY name)
  set_property(GLOBAL APPEND PROPERTY IDE_PROJECTS ${name})
  set(kind Library)
  if(ASSEMBLY MATCHES "\\.exe$")
    set(kind Exe)
  endif()
  set(items)
  foreach(source ${SOURCES})
    if(NOT source MATCHES "\\.cs$")
      string(APPEND source "/**/*.cs")
    endif()
    string(APPEND items "    <Compile Include=\"${source}\" />\n")
  endforeach()
  foreach(reference ${REFERENCES})
    cmake_path(GET reference STEM LAST_ONLY library)
    if(library IN_LIST projects)
      string(APPEND items "    <ProjectReference Include=\"${library}.csproj\" />\n")
    else()
      string(APPEND items "    <Reference Include=\"${library}\" HintPath=\"${reference}\" />\n")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT "${IDE}/${name}.csproj" CONTENT "<Project Sdk=\"Microsoft.NET.Sdk\">
  <PropertyGroup>
    <OutputType>${kind}</OutputType>
  </PropertyGroup>
  <ItemGroup>
${items}  </ItemGroup>
</Project>
")
endfunction()

function(ide_solution)
  get_property(projects GLOBAL PROPERTY IDE_PROJECTS)
  list(TRANSFORM projects REPLACE "(.+)" "  <Project Path=\"\\1.csproj\" />\n")
  list(JOIN projects "" projects)
  file(CONFIGURE OUTPUT "${IDE}/Collektive.slnx" CONTENT "<Solution>\n${projects}</Solution>\n")
endfunction()
