using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public struct LayerMask
    {
        // The names of Unity's built-in layers. Other layers have no name in the headless player.
        static readonly string[] Names = { "Default", "TransparentFX", "Ignore Raycast", "", "Water", "UI" };

        static readonly HashSet<string> Unknown = new HashSet<string>();

        public int value { get; set; }

        public static implicit operator int(LayerMask mask) => mask.value;
        public static implicit operator LayerMask(int intVal) => new LayerMask { value = intVal };

        public static string LayerToName(int layer) => layer >= 0 && layer < Names.Length ? Names[layer] : "";

        public static int NameToLayer(string layerName)
        {
            Construction.Check(nameof(NameToLayer));
            var layer = string.IsNullOrEmpty(layerName) ? -1 : Array.IndexOf(Names, layerName);
            if (layer < 0 && Unknown.Add(layerName ?? ""))
                Debug.LogWarning($"The layer '{layerName}' is unknown. Without Unity, only built-in layers have names. Use its number.");
            return layer;
        }

        public static int GetMask(params string[] layerNames)
        {
            var mask = 0;
            foreach (var name in layerNames)
            {
                var layer = NameToLayer(name);
                if (layer >= 0) mask |= 1 << layer;
            }
            return mask;
        }
    }
}
