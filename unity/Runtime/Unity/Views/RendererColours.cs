using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Colours single objects without creating a material for each.</summary>
    internal static class RendererColours
    {
        // Shaders of the built-in pipeline and shaders of scriptable pipelines use different names for the colour.
        private static readonly int BuiltIn = Shader.PropertyToID("_Color");
        private static readonly int Scriptable = Shader.PropertyToID("_BaseColor");

        private static MaterialPropertyBlock block;

        internal static void Paint(this Renderer renderer, Color color)
        {
            block = block ?? new MaterialPropertyBlock();
            renderer.GetPropertyBlock(block);
            block.SetColor(BuiltIn, color);
            block.SetColor(Scriptable, color);
            renderer.SetPropertyBlock(block);
        }
    }
}
