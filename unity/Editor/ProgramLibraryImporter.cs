using System;
using System.IO;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Imports a jar with programs as a <see cref="ProgramLibrary"/> that contains its programs.</summary>
    [ScriptedImporter(2, ProgramLibrary.Extension)]
    internal sealed class ProgramLibraryImporter : ScriptedImporter
    {
        /// <summary>Identifier of the library. It must not change, because references in scenes contain a hash of it.</summary>
        private const string MainIdentifier = "<root>";

        /// <inheritdoc/>
        public override void OnImportAsset(AssetImportContext ctx)
        {
            var library = ScriptableObject.CreateInstance<ProgramLibrary>();
            library.name = Path.GetFileNameWithoutExtension(ctx.assetPath);
            var guid = AssetDatabase.AssetPathToGUID(ctx.assetPath);
            ctx.AddObjectToAsset(MainIdentifier, library);
            ctx.SetMainObject(library);
            try
            {
                var archive = ProgramArchive.Read(FileUtil.GetPhysicalPath(ctx.assetPath));
                var programs = new AggregateProgram[archive.Programs.Count];
                var count = 0;
                foreach (var program in archive.Programs)
                {
                    var asset = programs[count++] = ScriptableObject.CreateInstance<AggregateProgram>();
                    asset.name = program.Name;
                    asset.Set(program);
                    ctx.AddObjectToAsset(program.Name, asset);
                }
                library.Set(guid, archive.Schema, archive.SchemaHash, archive.Runtime, archive.SourcesHash, programs);
            }
            catch (Exception error) when (error is InvalidDataException || error is IOException || error is UnauthorizedAccessException)
            {
                library.Set(guid, "", "", "", "", new AggregateProgram[0]);
                ctx.LogImportError(ctx.assetPath + " is not a library of programs: " + error.Message, library);
            }
        }
    }
}
