using System.Collections.Generic;
using System.IO;
using UnityEditor;

namespace Collektive.Unity.Editor
{
    /// <summary>Draws a choice among the programs of a simulation's jars, below the text field of a program's name.</summary>
    internal static class ProgramPicker
    {
        /// <summary>Draws the choice; an unknown name is an error that lists the known ones.</summary>
        /// <param name="field">The program's name; the choice is written there.</param>
        /// <param name="none">What an empty name means.</param>
        internal static void Draw(SerializedProperty field, ProgramIndex index, string none)
        {
            if (index == null) return;
            var name = field.stringValue;
            if (index.Names.Count > 0)
            {
                var options = new List<string> { none };
                options.AddRange(index.Names);
                var isKnown = name.Length == 0 || index.Names.Contains(name);
                if (!isKnown) options.Add(name + " (unknown)");
                var selected = name.Length == 0 ? 0 : isKnown ? options.IndexOf(name, 1) : options.Count - 1;
                var picked = EditorGUILayout.Popup("Choose program", selected, options.ToArray());
                if (picked != selected) field.stringValue = picked == 0 ? "" : options[picked];
                if (!isKnown && index.WithoutIndex == null)
                    EditorGUILayout.HelpBox("No program is named '" + name + "'. There is: " + string.Join(", ", index.Names), MessageType.Error);
            }
            if (index.WithoutIndex != null)
                EditorGUILayout.HelpBox(File.Exists(index.WithoutIndex)
                    ? index.WithoutIndex + " has no list of programs: type the program's name, or compile the jar with this version of "
                    + "the compiler plugin"
                    : index.WithoutIndex + " does not exist yet: press Play, or choose Tools > Collektive > Rebuild Programs", MessageType.None);
        }
    }
}
