using System;
using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public class AssetImporter : Object { }
}

namespace UnityEditor.AssetImporters
{
    [AttributeUsage(AttributeTargets.Class, Inherited = false)]
    public class ScriptedImporterAttribute : Attribute
    {
        public int version { get; }
        public string[] fileExtensions { get; }

        public ScriptedImporterAttribute(int version, string ext)
        {
            this.version = version;
            fileExtensions = new[] { ext };
        }
    }

    public abstract class ScriptedImporter : AssetImporter
    {
        public abstract void OnImportAsset(AssetImportContext ctx);
    }

    public class AssetImportContext
    {
        internal readonly Dictionary<string, Object> Objects = new Dictionary<string, Object>();

        internal AssetImportContext(string path) => assetPath = path;

        public string assetPath { get; }
        public Object mainObject { get; private set; }

        public void AddObjectToAsset(string identifier, Object obj)
        {
            if (!obj) throw new ArgumentNullException(nameof(obj));
            Objects.Add(identifier, obj);
        }

        public void SetMainObject(Object obj) => mainObject = obj;
        public void LogImportError(string msg, Object obj = null) => Debug.LogError(msg, obj);
    }
}
