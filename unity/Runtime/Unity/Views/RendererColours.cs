using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Colours single objects without creating a material for each.</summary>
    internal static class RendererColours
    {
        // The built-in pipeline's shaders and those of the scriptable ones name the colour differently.
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
