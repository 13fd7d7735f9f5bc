using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public sealed class MaterialPropertyBlock
    {
        readonly Dictionary<int, Vector4> values = new Dictionary<int, Vector4>();
        readonly Dictionary<int, Vector4[]> arrays = new Dictionary<int, Vector4[]>();

        readonly Dictionary<int, GraphicsBuffer> buffers = new Dictionary<int, GraphicsBuffer>();

        public bool isEmpty => values.Count == 0 && arrays.Count == 0 && buffers.Count == 0;

        public void Clear()
        {
            values.Clear();
            arrays.Clear();
            buffers.Clear();
        }

        public void SetInt(string name, int value) => SetInt(Shader.PropertyToID(name), value);
        public void SetInt(int nameID, int value) => SetFloat(nameID, value);
        public void SetInteger(string name, int value) => SetInt(name, value);
        public void SetInteger(int nameID, int value) => SetInt(nameID, value);
        public void SetFloat(string name, float value) => SetFloat(Shader.PropertyToID(name), value);
        public void SetFloat(int nameID, float value) => SetVector(nameID, new Vector4(value, 0f, 0f, 0f));
        public void SetColor(string name, Color value) => SetColor(Shader.PropertyToID(name), value);
        public void SetColor(int nameID, Color value) => SetVector(nameID, value);
        public void SetVector(string name, Vector4 value) => SetVector(Shader.PropertyToID(name), value);
        public void SetVector(int nameID, Vector4 value) => values[nameID] = value;
        public void SetVectorArray(string name, Vector4[] values) => SetVectorArray(Shader.PropertyToID(name), values);
        public void SetVectorArray(string name, List<Vector4> values) => SetVectorArray(Shader.PropertyToID(name), values);
        public void SetVectorArray(int nameID, List<Vector4> values) => SetVectorArray(nameID, values.ToArray());

        /// As in Unity, the first array determines the length. Values beyond it are ignored.
        public void SetVectorArray(int nameID, Vector4[] values)
        {
            if (values.Length == 0) throw new ArgumentException("An array property needs at least one value.", nameof(values));
            if (!arrays.TryGetValue(nameID, out var array)) arrays[nameID] = array = new Vector4[values.Length];
            Array.Copy(values, array, Math.Min(values.Length, array.Length));
        }

        public void SetBuffer(string name, GraphicsBuffer value) => SetBuffer(Shader.PropertyToID(name), value);
        public void SetBuffer(int nameID, GraphicsBuffer value) => buffers[nameID] = value;

        /// Returns the buffer that a shader reads.
        internal GraphicsBuffer BufferOf(string name) => buffers[Shader.PropertyToID(name)];

        public float GetFloat(string name) => GetFloat(Shader.PropertyToID(name));
        public float GetFloat(int nameID) => GetVector(nameID).x;
        public Color GetColor(string name) => GetColor(Shader.PropertyToID(name));
        public Color GetColor(int nameID) => GetVector(nameID);
        public Vector4 GetVector(string name) => GetVector(Shader.PropertyToID(name));
        public Vector4 GetVector(int nameID) => values.TryGetValue(nameID, out var value) ? value : default;
        public Vector4[] GetVectorArray(string name) => GetVectorArray(Shader.PropertyToID(name));
        public Vector4[] GetVectorArray(int nameID) => arrays.TryGetValue(nameID, out var array) ? (Vector4[])array.Clone() : null;

        internal bool Has(int nameID) => values.ContainsKey(nameID) || arrays.ContainsKey(nameID);

        internal void CopyFrom(MaterialPropertyBlock other)
        {
            Clear();
            foreach (var pair in other.values) values.Add(pair.Key, pair.Value);
            foreach (var pair in other.buffers) buffers.Add(pair.Key, pair.Value);
            foreach (var pair in other.arrays) arrays.Add(pair.Key, (Vector4[])pair.Value.Clone());
        }
    }
}
