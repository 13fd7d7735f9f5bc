using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine;
using UnityEngine.UIElements;

namespace UnityEditor.Headless
{
    /// Calls members that the editor finds by name or attribute: menu entries, window messages and load methods.
    public static class Menus
    {
        const BindingFlags Statics = BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;

        internal static bool Click(string path)
        {
            foreach (var method in Marked(typeof(MenuItem)))
            {
                if (method.GetCustomAttribute<MenuItem>().menuItem != path) continue;
                method.Invoke(null, method.GetParameters().Length == 0 ? null : new object[] { new MenuCommand(null) });
                return true;
            }
            return false;
        }

        /// Calls all methods with [InitializeOnLoadMethod], as the editor does when it loads a domain.
        public static void Load()
        {
            foreach (var method in Marked(typeof(InitializeOnLoadMethodAttribute))) AssetState.Reload(() => method.Invoke(null, null));
        }

        /// Returns all pages of the project settings.
        public static List<SettingsProvider> SettingsPages()
        {
            var pages = new List<SettingsProvider>();
            foreach (var method in Marked(typeof(SettingsProviderAttribute))) pages.Add((SettingsProvider)method.Invoke(null, null));
            return pages;
        }

        /// Returns the drawer that has [CustomPropertyDrawer] for an attribute or a type.
        public static PropertyDrawer DrawerOf(Type attribute)
        {
            foreach (var type in EditorTypes())
            {
                var mark = type.GetCustomAttribute<CustomPropertyDrawer>();
                if (mark != null && mark.type == attribute) return (PropertyDrawer)Activator.CreateInstance(type, true);
            }
            return null;
        }

        /// Returns the drawer of a field, which depends on an attribute or on the type of the field.
        internal static PropertyDrawer DrawerOf(FieldInfo field)
        {
            foreach (var attribute in field.GetCustomAttributes<PropertyAttribute>())
            {
                if (!(DrawerOf(attribute.GetType()) is PropertyDrawer drawer)) continue;
                drawer.attribute = attribute;
                return drawer;
            }
            return DrawerOf(field.FieldType);
        }

        /// The entries of the last context menu that was shown.
        public static IEnumerable<string> ContextItems => GenericMenu.Shown.Items;

        public static void PickContextItem(string item) => GenericMenu.Shown.Pick(item);

        public static void ChangePlayMode(PlayModeStateChange change) => EditorApplication.RaisePlayMode(change);

        /// Runs one iteration of the editor's loop.
        public static void Tick() => EditorApplication.Tick();

        /// Calls all postprocessors, as the editor does after an import. If no asset changed, it simulates a reload of the domain.
        public static void Postprocess(string[] imported, string[] deleted)
        {
            foreach (var type in EditorTypes())
                if (typeof(AssetPostprocessor).IsAssignableFrom(type))
                    type.GetMethod("OnPostprocessAllAssets", Statics)?.Invoke(
                        null, new object[] { imported, deleted, new string[0], new string[0], imported.Length + deleted.Length == 0 });
        }

        /// Sends a message by name if the object has such a method. Exceptions are not wrapped.
        public static void Send(object receiver, string message)
        {
            var method = receiver.GetType().GetMethod(message, BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
            var call = (Action)method?.CreateDelegate(typeof(Action), receiver);
            if (message == "OnGUI") UnityEngine.Headless.Gui.Passes(call);
            else call?.Invoke();
        }

        /// Draws the visible elements of a window. The window creates its elements on the first call. Rows of tables become lines such as "row 0 | Name".
        public static void Draw(EditorWindow window)
        {
            if (!window.HasGui) Send(window, "CreateGUI");
            window.HasGui = true;
            UnityEngine.Headless.Gui.Passes(() =>
            {
                foreach (var element in window.rootVisualElement.Children())
                {
                    if (element.style.display.value == DisplayStyle.None) continue;
                    if (element is IMGUIContainer container) container.onGUIHandler();
                    else if (element is MultiColumnListView table)
                        foreach (var row in table.VisibleRows(window.position.height)) UnityEngine.Headless.Gui.Draw("row", row);
                }
            });
        }

        internal static IEnumerable<Type> EditorTypes()
        {
            var own = typeof(Menus).Assembly.GetName().Name;
            foreach (var assembly in AppDomain.CurrentDomain.GetAssemblies())
                if (Array.Exists(assembly.GetReferencedAssemblies(), reference => reference.Name == own))
                    foreach (var type in assembly.GetTypes()) yield return type;
        }

        static IEnumerable<MethodInfo> Marked(Type attribute)
        {
            foreach (var type in EditorTypes())
                foreach (var method in type.GetMethods(Statics))
                    if (method.IsDefined(attribute, false)) yield return method;
        }
    }
}
