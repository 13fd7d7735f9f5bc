using System;

namespace UnityEngine
{
    public class Material : Object
    {
        static readonly int ColorId = Shader.PropertyToID("_Color");
        static Material shared;

        /// Material of new primitives. Scripts can change it.
        internal static Material Default => shared = shared ?? new Material(Shader.Find("Standard")) { name = "Default-Material" };

        internal static void ResetState() => shared = null;

        readonly MaterialPropertyBlock ownProperties = new MaterialPropertyBlock();
        Shader ownShader;
        bool isInstanced;
        int queue = -1;

        MaterialPropertyBlock properties => this.Existing().ownProperties;

        public Material(Shader shader)
        {
            this.shader = shader;
            if (shader.name == "Collektive/Link") SetFloat("_LinkWidth", 0.04f);
            else color = Color.white;
        }

        public Material(Material source)
        {
            shader = source.shader;
            enableInstancing = source.enableInstancing;
            renderQueue = source.renderQueue;
            properties.CopyFrom(source.properties);
        }

        public Shader shader { get => this.Existing().ownShader; set => this.Existing().ownShader = value; }
        public bool enableInstancing { get => this.Existing().isInstanced; set => this.Existing().isInstanced = value; }
        public int renderQueue { get => this.Existing().queue; set => this.Existing().queue = value; }
        public Color color { get => GetColor(ColorId); set => SetColor(ColorId, value); }

        public bool HasProperty(string name) => HasProperty(Shader.PropertyToID(name));
        public bool HasProperty(int nameID) => properties.Has(nameID);
        public void SetFloat(string name, float value) => properties.SetFloat(name, value);
        public void SetFloat(int nameID, float value) => properties.SetFloat(nameID, value);
        public float GetFloat(string name) => properties.GetFloat(name);
        public float GetFloat(int nameID) => properties.GetFloat(nameID);
        public void SetColor(string name, Color value) => properties.SetColor(name, value);
        public void SetColor(int nameID, Color value) => properties.SetColor(nameID, value);
        public Color GetColor(string name) => properties.GetColor(name);
        public Color GetColor(int nameID) => properties.GetColor(nameID);
        public void EnableKeyword(string keyword) => ThrowIfDestroyed();
        public void DisableKeyword(string keyword) => ThrowIfDestroyed();
    }

    public sealed class Shader : Object
    {
        static readonly System.Collections.Generic.List<string> Names = new System.Collections.Generic.List<string>();

        Shader() { }

        public static Shader Find(string name) => new Shader { name = name };

        public static int PropertyToID(string name)
        {
            if (string.IsNullOrEmpty(name)) throw new ArgumentException("A shader property needs a name.", nameof(name));
            var known = Names.IndexOf(name);
            if (known >= 0) return known;
            Names.Add(name);
            return Names.Count - 1;
        }
    }
}
